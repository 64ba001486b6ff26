// Talk with the server: all of it is JSON, and an error is a text for people.

// The keys of the session, of this origin alone: a cookie goes to every port of the machine.
const kKeys = "dashpot-keys";
const keys = () => JSON.parse(localStorage.getItem(kKeys) ?? "{}");
const with_key = (headers) => ({headers: {...headers, "X-Dashpot-Key": keys().key ?? ""}});
// An address that the browser itself opens.
export const opened = (address) => `${address}${address.includes("?") ? "&" : "?"}session=${keys().address_key ?? ""}`;

async function answer_of(response) {
  const value = await response.json().catch(() => ({error: `the studio answered ${response.status}`}));
  if (value.error && !response.ok) throw new Error(value.error);
  return value;
}

export const ask = async (path, parameters = {}) => {
  const query = new URLSearchParams(Object.entries(parameters).filter(([, value]) => value !== undefined));
  return answer_of(await fetch(`${path}${query.size ? `?${query}` : ""}`, with_key({})));
};

export const tell = async (path, body) => answer_of(await fetch(path,
  {method: "POST", ...with_key({"Content-Type": "application/json"}), body: JSON.stringify(body)}));

export const upload = async (name, file) => answer_of(await fetch(`/api/upload?name=${encodeURIComponent(name)}`,
  {method: "POST", ...with_key({"Content-Type": "application/octet-stream"}), body: file}));

// The one-time token of the address becomes a cookie and keys, and leaves the address.
export async function open_session() {
  const token = location.hash.slice(1);
  history.replaceState(null, "", "/");
  if (token) await tell("/api/session", {token}).then((got) => localStorage.setItem(kKeys, JSON.stringify(got))).catch(() => {});
}

// One word of a command line, quoted for a shell where it must be.
export const quoted = (word) => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
export const command_text = (words) => ["dashpot", ...words].map(quoted).join(" ");
