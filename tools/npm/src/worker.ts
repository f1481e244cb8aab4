import { makeListener } from "./worker_loop.js";

const listen = makeListener((message, transfer = []) => postMessage(message, { transfer }));
addEventListener("message", ({ data }) => listen(data));
