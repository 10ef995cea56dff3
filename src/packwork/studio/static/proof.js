// @ts-check
/**
 * Who is there: a page knows the secret in its address, never sends it, and asks the studio to
 * prove that it knows it too. What the program at this port then gets is a token derived from it.
 */

/**
 * Code of a text under a key, as the studio makes it.
 * @param {string} key
 * @param {string} text
 */
async function mac(key, text) {
  const bytes = (/** @type {string} */ one) => new TextEncoder().encode(one);
  const made = await crypto.subtle.importKey("raw", bytes(key), { name: "HMAC", hash: "SHA-256" }, false, ["sign"]);
  return hex(new Uint8Array(await crypto.subtle.sign("HMAC", made, bytes(text))));
}

/** @param {Uint8Array} bytes */
export function hex(bytes) {
  return [...bytes].map((one) => one.toString(16).padStart(2, "0")).join("");
}

/** How long an answer may take, ms: a program that is stopped takes questions and answers none. */
const PATIENCE = 5000;

/** Token for the studio at this address; empty if what is there has not proved to be it. Throws if nothing is there. */
export async function provenToken() {
  const secret = location.hash.slice(1);
  // Without encryption, reached from elsewhere: browsers derive nothing there.
  if (!secret || !globalThis.crypto?.subtle) return secret;
  const key = await mac(secret, "key");
  const nonce = hex(crypto.getRandomValues(new Uint8Array(16)));
  const answer = await fetch(`/proof/${nonce}`, { signal: AbortSignal.timeout(PATIENCE) });
  if (!answer.ok) return "";
  const said = await answer.json();
  const expected = await mac(key, `studio ${location.host} ${nonce}`);
  if (said.now === expected) return mac(secret, "token");
  return said.before === expected ? mac(await nextSecret(key, said.nonce), "token") : "";
}

/**
 * The secret of a studio that has opened the desk again; it takes the place of the one before.
 * @param {string} key
 * @param {string} nonce what the studio wants signed
 */
async function nextSecret(key, nonce) {
  const proof = await mac(key, `page ${location.host} ${nonce}`);
  const answer = await fetch("/again", { method: "POST", headers: { "x-packwork-token": proof } });
  if (!answer.ok) throw new Error("the studio does not know this page");
  const { secret } = await answer.json();
  history.replaceState(null, "", `#${secret}`);
  return secret;
}
