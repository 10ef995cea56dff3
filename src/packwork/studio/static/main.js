// @ts-check
/** Opens the studio on this page. */

import { Studio } from "./studio.js";

const studio = new Studio();
studio.begin();
/** For those who look at the page from outside: tests, benchmarks, the curious. */
Object.assign(globalThis, { studio });
