// ONNX Runtime through its Node package, on one thread: argument 1 is the folder that holds node_modules.
// The network is written as an ONNX file here, by hand: a few fields of protocol buffers.
import { createRequire } from 'node:module';
import { createInterface } from 'node:readline';

const ort = createRequire(process.argv[2] + '/')('onnxruntime-node');
const kMany = 4096;

const varint = (n) => (n < 128 ? [n] : [(n & 127) | 128, ...varint(n >>> 7)]);
const whole = (field, n) => [...varint(field << 3), ...varint(n)];
const bytes = (field, data) => [...varint((field << 3) | 2), ...varint(data.length), ...data];
const text = (field, string) => bytes(field, Buffer.from(string));

const node = (type, inputs, output) =>
  bytes(1, [...inputs.flatMap((name) => text(1, name)), ...text(2, output), ...text(4, type)]);
const tensor = (name, dims) => {
  const data = Float32Array.from({ length: dims.reduce((a, b) => a * b) }, (_, k) => Math.sin(k + 1) / 3);
  return bytes(5, [...dims.flatMap((d) => whole(1, d)), ...whole(2, 1), ...text(8, name), ...bytes(9, Buffer.from(data.buffer))]);
};
const value = (field, name, width) => {
  const shape = bytes(2, [...bytes(1, whole(1, kMany)), ...bytes(1, whole(1, width))]);
  return bytes(field, [...text(1, name), ...bytes(2, bytes(1, [...whole(1, 1), ...shape]))]);
};

function model(layers, activation) {
  const graph = [];
  let from = 'x';
  for (let l = 1; l < layers.length; ++l) {
    const last = l + 1 === layers.length;
    const sum = last ? 'y' : `sum${l}`;
    graph.push(...node('Gemm', [from, `w${l}`, `b${l}`], sum));
    if (!last) graph.push(...node(activation, [sum], `a${l}`));
    from = `a${l}`;
  }
  graph.push(...text(2, 'network'));
  for (let l = 1; l < layers.length; ++l)
    graph.push(...tensor(`w${l}`, [layers[l - 1], layers[l]]), ...tensor(`b${l}`, [layers[l]]));
  graph.push(...value(11, 'x', layers[0]), ...value(12, 'y', layers.at(-1)));
  return Buffer.from([...whole(1, 8), ...bytes(7, graph), ...bytes(8, whole(2, 13))]);
}

async function task(layers, activation) {
  const session = await ort.InferenceSession.create(model(layers, activation), {
    intraOpNumThreads: 1, interOpNumThreads: 1, executionMode: 'sequential', graphOptimizationLevel: 'all',
  });
  const x = new ort.Tensor('float32', new Float32Array(kMany * layers[0]).fill(0.3), [kMany, layers[0]]);
  const y = new ort.Tensor('float32', new Float32Array(kMany), [kMany, 1]);
  return async () => {
    const start = process.cpuUsage();
    for (let k = 0; k < 40; ++k) await session.run({ x }, { y });
    const { user, system } = process.cpuUsage(start);
    return (user + system) * 1e-6 / 40 / kMany;
  };
}

const tasks = { batch_relu: await task([8, 15, 15, 15, 1], 'Relu'), batch_tanh: await task([2, 10, 1], 'Tanh') };
console.log(Object.keys(tasks).join(' '));
for await (const line of createInterface({ input: process.stdin })) console.log(await tasks[line.split(' ')[0]]());
