#!/usr/bin/env node
// A controller served by npm modbus-serial or jsmodbus (packages found through NODE_PATH): the register bank and the table
// transaction of docs/register-map.md, without a machine behind it.
//   peer_server.js modbus-serial|jsmodbus PROFILE.json      prints "ready modbus=PORT"
const fs = require('fs');
const net = require('net');
const zlib = require('zlib');

const bank = Buffer.alloc(6000 * 2);
const get = (a) => bank.readUInt16BE(2 * a);
const set = (a, v) => bank.writeUInt16BE(v & 0xffff, 2 * a);
for (const [a, v] of [[0, 0x5a44], [1, 1], [2, 15], [3, 2000], [5, 4712], [6, 20], [7, 5], [16, 4], [146, 10], [213, 100]]) {
  set(a, v);
}
for (let i = 96; i < 120; ++i) set(i, 16 * 22);

function crc32(buffer) {
  if (zlib.crc32) return zlib.crc32(buffer);
  let crc = ~0;
  for (const byte of buffer) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function react(first, count) {
  const hit = (a) => first <= a && a < first + count;
  if (hit(76)) set(17, get(76));
  if (hit(70)) set(70, 0);
  if (!hit(205) || get(205) === 0) return;
  const staged = bank.subarray(2000, 2000 + 2 * Math.min(get(200), 2000));
  const crc = crc32(staged);
  let reason = 0;
  if (get(17) !== 0) reason = 5;
  else if (crc !== get(202) * 65536 + get(203)) reason = 1;
  else if (get(204) === 0 || get(204) !== get(205)) reason = 8;
  if (reason === 0) {
    staged.copy(bank, 8000);
    set(208, crc >>> 16);
    set(209, crc & 0xffff);
    set(210, get(200));
    set(211, get(204));
  }
  set(206, reason === 0 ? 3 : 4);
  set(207, get(204));
  set(212, reason);
  set(205, 0);
}

function ready(port) {
  const sensors = [];
  for (let i = 1; i <= 20; ++i) sensors.push({channel: `T${i}_C`});
  fs.writeFileSync(process.argv[3], JSON.stringify({
    format: 'zerodrift-profile/1', name: 'Peer', time_factor: 1, sensors,
    controller: {kind: 'modbus-tcp', host: '127.0.0.1', port, unit: 1, register_map: 'zerodrift-virtual'}}));
  console.log(`ready modbus=${port}`);
}

if (process.argv[2] === 'jsmodbus') {
  const modbus = require('jsmodbus');
  const listener = net.createServer();
  const server = new modbus.server.TCP(listener, {holding: bank});
  server.on('postWriteSingleRegister', (request) => react(request.body.address, 1));
  // It also tells of multiple writes, but without the request; what must be reacted to are single registers.
  listener.listen(0, '127.0.0.1', () => ready(listener.address().port));
} else {
  const {ServerTCP} = require('modbus-serial');
  const probe = net.createServer().listen(0, '127.0.0.1', () => {
    const port = probe.address().port;
    probe.close(() => {
      const server = new ServerTCP({
        getHoldingRegister: (a) => get(a),
        getMultipleHoldingRegisters: (a, n) => Array.from({length: n}, (_, i) => get(a + i)),
        setRegister: (a, v) => { set(a, v); react(a, 1); },
      }, {host: '127.0.0.1', port, unitID: 1});
      server.on('initialized', () => ready(port));
    });
  });
}
