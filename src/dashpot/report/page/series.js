// The packed series of the page back to arrays of numbers.

function bytes_of(base64) {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

// {float32: base64} or {low, step, int16: base64}; the code -32768 stands for "not a number".
function unpack(packed) {
  if (packed.float32 !== undefined) return new Float32Array(bytes_of(packed.float32).buffer);
  const codes = new Int16Array(bytes_of(packed.int16).buffer);
  return Float64Array.from(codes, (code) => code === -32768 ? NaN : packed.low + packed.step * (code + 32767));
}

let shared_samples = [];
function share_samples(samples) {
  shared_samples = samples;
}

// Packed samples, or the place of shared ones. Unpacks on first use and keeps the result: a page may hold forty records.
const unpacked = new Map();
function series_of(source) {
  const packed = typeof source === "number" ? shared_samples[source] : source;
  if (!unpacked.has(packed)) unpacked.set(packed, unpack(packed));
  return unpacked.get(packed);
}

function difference(a, b) {
  return Float64Array.from(a, (value, i) => value - b[i]);
}

// [least, greatest] of the finite numbers, or null when there is none.
function extent(values, range = null) {
  let low = range ? range[0] : Infinity, high = range ? range[1] : -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return Number.isFinite(low) && Number.isFinite(high) ? [low, high] : range;
}
