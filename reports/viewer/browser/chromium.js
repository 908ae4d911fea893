// Headless Chromium by the DevTools protocol over two pipes, so that nothing but node is needed and no port is opened.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const FLAGS = ['--headless=new', '--no-sandbox', '--remote-debugging-pipe', '--no-first-run', '--disable-dev-shm-usage',
  '--disable-background-networking', '--disable-component-update', '--disable-extensions', '--hide-scrollbars',
  '--host-resolver-rules=MAP * ~NOTFOUND', // no network, whatever asks
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];

/** Splits what comes through a pipe into messages, each of which a zero byte ends. */
export class MessageSplitter {
  constructor(onMessage) {
    this.parts = [];
    this.onMessage = onMessage;
  }

  add(chunk) {
    let begin = 0;
    for (let end = chunk.indexOf(0); end >= 0; end = chunk.indexOf(0, begin)) {
      this.parts.push(chunk.subarray(begin, end));
      this.onMessage(JSON.parse(Buffer.concat(this.parts).toString('utf8')));
      this.parts = [];
      begin = end + 1;
    }
    this.parts.push(chunk.subarray(begin));
  }
}

export class Chromium {
  constructor(program = 'chromium') {
    this.profile = mkdtempSync(join(tmpdir(), 'cbc3d-chromium-'));
    this.process = spawn(program, [...FLAGS, `--user-data-dir=${this.profile}`, 'about:blank'],
      {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    this.waiting = new Map();
    this.listeners = [];
    this.last = 0;
    this.failed = new Promise((_, reject) => {
      this.process.on('error', reject);
      this.process.on('exit', (code, signal) => reject(new Error(`chromium ended: ${signal ?? code}`)));
    });
    this.failed.catch(() => {});
    const splitter = new MessageSplitter((message) => this.take(message));
    this.process.stdio[4].on('data', (chunk) => splitter.add(chunk));
    this.process.stdio[3].on('error', () => {});
  }

  take(message) {
    const waiting = this.waiting.get(message.id);
    if (!waiting) {
      this.listeners.forEach((listener) => listener(message));
      return;
    }
    this.waiting.delete(message.id);
    if (message.error) waiting.reject(new Error(message.error.message));
    else waiting.resolve(message.result);
  }

  send(method, params = {}, sessionId = this.session) {
    const id = ++this.last;
    const answer = new Promise((resolve, reject) => this.waiting.set(id, {resolve, reject}));
    this.process.stdio[3].write(`${JSON.stringify({id, method, params, sessionId})}\0`);
    return Promise.race([answer, this.failed]);
  }

  /** A page with the network off; `faults` collects its errors and what it asks the network for. */
  async openPage() {
    this.faults = [];
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'}, undefined);
    this.session = (await this.send('Target.attachToTarget', {targetId, flatten: true}, undefined)).sessionId;
    this.listeners.push(({method, params}) => {
      if (method === 'Runtime.exceptionThrown') this.faults.push(params.exceptionDetails.exception?.description ?? 'exception');
      if (method === 'Log.entryAdded' && params.entry.level === 'error') this.faults.push(params.entry.text);
      if (method === 'Network.requestWillBeSent' && !/^(file|data|blob):/.test(params.request.url)) {
        this.faults.push(`asks for ${params.request.url}`);
      }
    });
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await this.send(`${domain}.enable`);
    await this.send('Network.emulateNetworkConditions', {offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0});
  }

  size(width, height) {
    return this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: width < 600});
  }

  async goTo(url) {
    const loaded = new Promise((resolve) => this.listeners.push(({method}) => method === 'Page.loadEventFired' && resolve()));
    await this.send('Page.navigate', {url});
    await Promise.race([loaded, this.failed]);
  }

  /** The value of an expression, or of the promise that it is. */
  async evaluate(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  mouse(type, x, y, buttons = 0) {
    const button = buttons || type === 'mouseReleased' ? 'left' : 'none';
    return this.send('Input.dispatchMouseEvent', {type, x, y, button, buttons, clickCount: type === 'mouseMoved' ? 0 : 1});
  }

  async click(x, y) {
    await this.mouse('mouseMoved', x, y);
    await this.mouse('mousePressed', x, y, 1);
    await this.mouse('mouseReleased', x, y);
  }

  async drag(from, to) {
    await this.mouse('mouseMoved', ...from);
    await this.mouse('mousePressed', ...from, 1);
    for (const share of [0.25, 0.5, 0.75, 1]) {
      await this.mouse('mouseMoved', from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), 1);
    }
    await this.mouse('mouseReleased', ...to);
  }

  async key(key, text) {
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', key, code: key, text, windowsVirtualKeyCode: key === 'Enter' ? 13 : undefined});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key, code: key});
  }

  async screenshot() {
    return Buffer.from((await this.send('Page.captureScreenshot', {format: 'png'})).data, 'base64');
  }

  async close() {
    this.process.removeAllListeners('exit');
    const ended = new Promise((resolve) => this.process.on('exit', resolve));
    this.process.kill('SIGKILL');
    await ended;
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 5});
  }
}
