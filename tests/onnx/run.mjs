// Runs exported ONNX models in ONNX Runtime and compares their forces with the library's.
//   node run.mjs FOLDER: every NAME.onnx there, along the run in NAME.json
// step by step as one damper, and as three dampers at once of which each is another part of the run ahead.
import { readFileSync, readdirSync } from 'node:fs';
import * as ort from 'onnxruntime-node';

const folder = process.argv[2];
const options = { intraOpNumThreads: 1, interOpNumThreads: 1, logSeverityLevel: 3 };
const load = (name) => ort.InferenceSession.create(`${folder}/${name}.onnx`, options);

const tensor = (type, rows) => {
  const numbers = type === 'float64' ? Float64Array : Float32Array;
  return new ort.Tensor(type, numbers.from(rows.flat()), [rows.length, rows[0].length]);
};

/// The forces of dampers that go through runs of the same length beside each other.
async function forces(step, rest, runs, type) {
  const feeds = (session, k, state) => {
    const given = {};
    for (const name of session.inputNames)
      given[name] = name === 'state' ? state : tensor(type, runs.map((run) => [run[k][name]]));
    return given;
  };
  const out = runs.map(() => []);
  let state;
  for (let k = 0; k < runs[0].length; ++k) {
    const session = k === 0 && rest ? rest : step;
    const result = await session.run(feeds(session, k, state));
    state = result.next_state ?? result.state;
    result.force.data.forEach((force, lane) => out[lane].push(force));
  }
  return out;
}

const largest = (a, b) => a.reduce((most, value, k) => Math.max(most, Number.isFinite(value) ? Math.abs(value - b[k]) : Infinity), 0);

const names = readdirSync(folder).filter((name) => name.endsWith('.json')).map((name) => name.slice(0, -5)).sort();
let bad = 0;
for (const name of names) {
  const { run, force, lanes, type, tolerance } = JSON.parse(readFileSync(`${folder}/${name}.json`));
  try {
    const step = await load(name), rest = step.inputNames.includes('state') ? await load(`${name}_rest`) : undefined;
    const span = Math.max(...force) - Math.min(...force);
    const begin = process.cpuUsage();
    const [alone] = await forces(step, rest, [run], type);
    const { user, system } = process.cpuUsage(begin);
    const beside = await forces(step, rest, lanes.map((lane) => lane.run), type);
    const error = largest(alone, force) / span;
    const errors = beside.map((one, k) => largest(one, lanes[k].force) / span);
    const passes = error <= tolerance && errors.every((one) => one <= tolerance);
    bad += passes ? 0 : 1;
    console.log(`${passes ? 'ok' : 'FAILED'} ${name} ${error.toExponential(1)} ${Math.max(...errors).toExponential(1)} of the span, ${((user + system) / run.length).toFixed(0)} us a step`);
  } catch (error) {
    bad += 1;
    console.log(`FAILED ${name}: ${error.message}`);
  }
}
console.log(`${names.length} models, ${bad} failed`);
process.exit(bad === 0 && names.length > 0 ? 0 : 1);
