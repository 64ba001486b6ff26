// Runs exported JavaScript and compares its forces with those that are known.
//   node js.mjs FOLDER: every NAME.mjs there, along the run in NAME.json: {inputs, forces, parameters, dt}
// Each damper steps beside a second one, which comes a step later and must give the same.
import { readFileSync, readdirSync, statSync } from 'node:fs';

const folder = process.argv[2];
const names = readdirSync(folder).filter((name) => name.endsWith('.json')).map((name) => name.slice(0, -5)).sort();
let bad = 0, given_before;
for (const name of names) {
  try {
    const { inputs, forces, parameters, dt } = JSON.parse(readFileSync(`${folder}/${name}.json`));
    const { model, create, reset, step, advance, force } = await import(`${folder}/${name}.mjs`);
    const state = create(parameters), later = create(parameters), begin = process.cpuUsage();
    const given = inputs.map((input, k) => {
      const one = k === 0 ? reset(state, ...input) : dt ? advance(state, ...input, dt) : step(state, ...input);
      if (k === 1) reset(later, ...inputs[0]);
      if (k > 1) advance(later, ...inputs[k - 1], dt ?? model.sample_time);
      if (k > 1 && force(later, ...inputs[k - 1]) !== given_before) throw new Error('two dampers disturb each other');
      given_before = one;
      return one;
    });
    const { user, system } = process.cpuUsage(begin);
    const span = Math.max(...forces) - Math.min(...forces);
    const error = given.reduce((most, one, k) => Math.max(most, Number.isFinite(one) ? Math.abs(one - forces[k]) : Infinity), 0) / span;
    // A family by physics iterates to 1e-9: another last digit of a power may save or cost it a step.
    const passes = error <= (name.startsWith('family_physics') ? 1e-9 : 1e-12);
    bad += passes ? 0 : 1;
    console.log(`${passes ? 'ok' : 'FAILED'} ${name} ${error.toExponential(1)} of the span, ${((user + system) / given.length / 2).toFixed(1)} us a step, ${statSync(`${folder}/${name}.mjs`).size} bytes`);
  } catch (error) {
    bad += 1;
    console.log(`FAILED ${name}: ${error.stack}`);
  }
}
console.log(`${names.length} models, ${bad} failed`);
process.exit(bad === 0 && names.length > 0 ? 0 : 1);
