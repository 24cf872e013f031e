// Reads a recording by its index with @mcap/core, every checksum checked, and decodes it with protobufjs by its own
// descriptors; messages of well-known schemas are held against Foxglove's JSON schemas. Prints what it found as JSON.
import { open } from "node:fs/promises";
import { McapIndexedReader } from "@mcap/core";
import { loadDecompressHandlers, protobufFromBinaryDescriptor } from "@mcap/support";
import * as published from "@foxglove/schemas/jsonschema.js";

class Readable {
  constructor(handle, size) { this.handle = handle; this.bytes = size; }
  async size() { return BigInt(this.bytes); }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    if (bytesRead !== buffer.length) throw new Error(`${bytesRead} of ${length} bytes at ${offset}`);
    return buffer;
  }
}

const problems = [];
function check(schema, value, where) {
  if (value == undefined) return; // proto3 leaves out what is zero
  if (schema.oneOf) {
    if (schema.oneOf.every((one) => one.const !== value)) problems.push(`${where}: ${value} is none of its names`);
  } else if (schema.type === "object" && schema.properties) {
    for (const key of Object.keys(value)) {
      if (schema.title === "time" || schema.title === "duration") continue;
      if (!(key in schema.properties)) problems.push(`${where}: no field ${key}`);
      else check(schema.properties[key], value[key], `${where}.${key}`);
    }
  } else if (schema.type === "array") {
    value.forEach((item) => check(schema.items, item, `${where}[]`));
  } else if (schema.type === "number" && !Number.isFinite(value)) {
    problems.push(`${where}: ${value} is no number`);
  } else if (["string", "boolean"].includes(schema.type) && typeof value !== schema.type && schema.contentEncoding == undefined) {
    problems.push(`${where}: ${typeof value}, expected ${schema.type}`);
  }
}

const path = process.argv[2];
const handle = await open(path);
const readable = new Readable(handle, (await handle.stat()).size);
const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: await loadDecompressHandlers() });
const counts = {}, decoded = {}, last = {}, types = new Map();
for await (const message of reader.readMessages({ validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId);
  counts[channel.topic] = (counts[channel.topic] ?? 0) + 1;
  const schema = reader.schemasById.get(channel.schemaId);
  if (!schema) continue;
  if (!types.has(schema.id)) types.set(schema.id, protobufFromBinaryDescriptor(schema.data).lookupType(schema.name));
  const type = types.get(schema.id);
  const value = type.decode(message.data);
  decoded[channel.topic] = (decoded[channel.topic] ?? 0) + 1;
  if (schema.name.startsWith("foxglove.")) {
    const plain = type.toObject(value, { enums: Number, longs: Number });
    last[channel.topic] = plain;
    check(published[schema.name.slice("foxglove.".length)], plain, schema.name);
  }
}
const statistics = reader.statistics;
await handle.close();
console.log(JSON.stringify({
  counts, decoded, last, problems: [...new Set(problems)].slice(0, 20), messages: Number(statistics.messageCount),
}));
