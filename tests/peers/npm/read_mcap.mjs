// Reads a log with Foxglove's own reader, by its index and as a stream with all CRCs, and every
// message by the schema in the file. Usage: node read_mcap.mjs FILE; prints JSON.
import fs from "node:fs";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";

const bytes = fs.readFileSync(process.argv[2]);
const decompressHandlers = { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) };
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(length)),
};
const topics = {};
const readers = new Map();
const messageOf = (channel, schema, data) => {
  if (!readers.has(channel.id))
    readers.set(channel.id, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
  return readers.get(channel.id).readMessage(data);
};

const indexed = await McapIndexedReader.Initialize({ readable, decompressHandlers });
for await (const record of indexed.readMessages()) {
  const channel = indexed.channelsById.get(record.channelId);
  const schema = indexed.schemasById.get(channel.schemaId);
  const topic = (topics[channel.topic] ??= { type: schema.name, messages: 0 });
  topic.messages += 1;
  topic.last = messageOf(channel, schema, record.data);
}
const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(bytes);
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) streamed += record.type === "Message" ? 1 : 0;

const plain = (_, value) =>
  typeof value === "bigint" ? Number(value) : ArrayBuffer.isView(value) ? Array.from(value) : value;
console.log(JSON.stringify({
  profile: indexed.header.profile, statistics: indexed.statistics.messageCount, streamed, whole: stream.done(), topics,
}, plain));
