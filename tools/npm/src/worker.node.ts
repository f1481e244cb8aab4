import { parentPort } from "node:worker_threads";
import { makeListener } from "./worker_loop.js";

parentPort.on("message", makeListener((message, transfer) => parentPort.postMessage(message, transfer)));
