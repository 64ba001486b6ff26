// Runs exported ONNX models in ONNX Runtime and compares what they give with what is known.
//   node run.mjs FOLDER: every NAME.onnx there, along the runs in NAME.json
// step by step: the second of its three runs alone, then all three at once. Where answers are not given, those of
// the run alone stand for them. `inputs` says which columns of a run are which input.
import { readFileSync, readdirSync, statSync } from 'node:fs';
import * as ort from 'onnxruntime-node';

const folder = process.argv[2];
const options = { intraOpNumThreads: 1, interOpNumThreads: 1, logSeverityLevel: 3 };
const load = (name) => ort.InferenceSession.create(`${folder}/${name}.onnx`, options);

const tensor = (type, rows) => {
  const numbers = type === 'float64' ? Float64Array : Float32Array;
  return new ort.Tensor(type, numbers.from(rows.flat(), Number), [rows.length, rows[0].length]);  // Number: of "NaN"
};

/// For runs beside each other, what comes out of each at each step.
async function answersOf({ step, rest, inputs, output, type }, runs) {
  const feeds = (session, k, state) => {
    const given = {};
    for (const name of session.inputNames)
      given[name] = name === 'state' ? state : tensor(type, runs.map((run) => run[k].slice(...inputs[name])));
    return given;
  };
  const out = runs.map(() => []);
  let state;
  for (let k = 0; k < Math.min(...runs.map((run) => run.length)); ++k) {
    const session = k === 0 && rest ? rest : step;
    const result = await session.run(feeds(session, k, state));
    state = result.next_state ?? result.state;
    const { data, dims } = result[output];
    out.forEach((rows, lane) => rows.push(Array.from(data.slice(lane * dims[1], (lane + 1) * dims[1]))));
  }
  return out;
}

/// Where an answer makes a difference.
const largest = (given, { answers, matters }) => given.reduce((most, row, k) => row.reduce((sum, value, j) =>
  matters?.[k][0] === 0 ? sum : Math.max(sum, Number.isFinite(value) ? Math.abs(value - answers[k][j]) : Infinity), most), 0);

const names = readdirSync(folder).filter((name) => name.endsWith('.json')).map((name) => name.slice(0, -5)).sort();
let bad = 0;
for (const name of names) {
  const { runs, inputs, output, type, span, tolerance } = JSON.parse(readFileSync(`${folder}/${name}.json`));
  try {
    const step = await load(name), rest = step.inputNames.includes('state') ? await load(`${name}_rest`) : undefined;
    const model = { step, rest, inputs, output, type };
    const begin = process.cpuUsage();
    const [alone] = await answersOf(model, [runs[1].inputs]);
    const { user, system } = process.cpuUsage(begin);
    const error = largest(alone, runs[1]) / span;
    for (const run of runs) run.answers ??= (await answersOf(model, [run.inputs]))[0];
    const errors = (await answersOf(model, runs.map((run) => run.inputs))).map((one, k) => largest(one, runs[k]) / span);
    const passes = error <= tolerance && errors.every((one) => one <= tolerance);
    bad += passes ? 0 : 1;
    console.log(`${passes ? 'ok' : 'FAILED'} ${name} ${error.toExponential(1)} ${Math.max(...errors).toExponential(1)} of the span, ${((user + system) / alone.length).toFixed(0)} us a step, ${statSync(`${folder}/${name}.onnx`).size} bytes`);
  } catch (error) {
    bad += 1;
    console.log(`FAILED ${name}: ${error.message}`);
  }
}
console.log(`${names.length} models, ${bad} failed`);
process.exit(bad === 0 && names.length > 0 ? 0 : 1);
