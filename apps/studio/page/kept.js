// What a view was set to, while another one is looked at.
import {useState} from "/htm.mjs";

const store = new Map();
export const keep = (key, value) => store.set(key, value);
export function useKept(key, initial) {
  const [value, set_value] = useState(store.has(key) ? store.get(key) : initial);
  return [value, (next) => { store.set(key, next); set_value(next); }];
}
