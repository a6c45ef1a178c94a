import { number, t } from './messages';
import type { Section, State, Triple } from './types';
import type { Hit, Ray } from './viewer';

const KEY = 'frangia-key';
const ID = 'frangia-id';

/** Statuses by which a proxy says that the server gave no answer. */
const UNANSWERED = [502, 503, 504];
const FORBIDDEN = 403;
const ATTEMPTS = 6;
/** Sockets that do not open before the page asks why. */
const SOCKETS_TO_TRY = 3;

const pause = (milliseconds: number): Promise<void> => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** An id that no other command has. Pages without TLS have no `crypto.randomUUID`. */
const newId = (): string =>
  Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, '0')).join('');

export type Layer = 'none' | 'camera' | 'phase' | 'modulation' | 'status' | 'depth' | 'points';

/** The largest file that the server takes. */
const MOST_BYTES = 512 * 1024 * 1024;

/** Before anything is read: the server would refuse it at the end. */
export function requireSendable(bytes: number): void {
  const MB = 2 ** 20;
  if (bytes > MOST_BYTES) throw new Error(t('open.large', { size: number(bytes / MB), most: number(MOST_BYTES / MB) }));
}

/** Status of a refusal because another browser operates. */
export const CONFLICT = 409;

/** A refusal of the server, in its words. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    sentence: string,
  ) {
    super(sentence);
  }
}

async function answerOf(response: Response): Promise<Response> {
  if (response.ok) return response;
  let sentence = response.statusText;
  try {
    sentence = ((await response.json()) as { error: string }).error;
  } catch {
    // Not JSON: a proxy between, whose status is all there is.
  }
  throw new Refusal(response.status, sentence);
}

/** How tablets in the network of the scanner reach it. */
export interface Lan {
  addresses: string[];
  /** `fingerprint` of the certificate; empty without encryption. */
  open: { url: string; link: string; password: string; fingerprint: string } | null;
}

export type Link = 'connecting' | 'open' | 'lost' | 'refused';

/**
 * The connection to the server. The launch token stands in the fragment of the address, which is never sent; it is
 * exchanged once for a key that only this origin's pages in this tab can read.
 */
export class Session {
  state: State | null = null;
  link: Link = 'connecting';
  private key: string | null = sessionStorage.getItem(KEY);
  /** Public name of the session that may act; the others watch. */
  operator = '';
  private id = sessionStorage.getItem(ID) ?? '';
  /** Requests that the server has not answered yet. */
  unanswered = 0;
  private patience = 500;
  private socket: WebSocket | null = null;
  /** Sockets in a row that were never open. */
  private unopened = 0;
  /** Whether the server answers requests, and its socket does not open all the same. */
  blocked = false;
  private layer: Layer = 'none';

  constructor(
    private readonly changed: () => void,
    private readonly pictured: (picture: ArrayBuffer) => void,
  ) {}

  /** Whether another browser operates. */
  get watches(): boolean {
    return this.operator !== '' && this.operator !== this.id;
  }

  async takeOver(): Promise<void> {
    await this.post('/api/operator', {});
  }

  /** Chooses the live pictures that the server sends. */
  show(layer: Layer): void {
    if (layer === this.layer) return;
    this.layer = layer;
    if (this.socket?.readyState === WebSocket.OPEN && this.link === 'open')
      this.socket.send(JSON.stringify({ type: 'show', layer }));
  }

  async enter(password: string): Promise<void> {
    await this.exchange({ password });
    this.listen();
  }

  private async exchange(proof: { token: string } | { password: string }): Promise<void> {
    const response = await answerOf(
      await fetch('/api/session', {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify(proof),
      }),
    );
    const { key, id } = (await response.json()) as { key: string; id: string };
    this.key = key;
    this.id = id;
    sessionStorage.setItem(KEY, key);
    sessionStorage.setItem(ID, id);
  }

  private async post(path: string, body: object): Promise<Response> {
    return this.request(path, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(body),
    });
  }

  async begin(): Promise<void> {
    addEventListener('hashchange', () => void this.renew());
    await this.takeLink();
    if (!this.key) return this.set('refused');
    this.listen();
  }

  /** Exchanges the token of the address, if it has one that is valid, for a key. */
  private async takeLink(): Promise<boolean> {
    const token = new URLSearchParams(location.hash.slice(1)).get('token');
    if (!token) return false;
    history.replaceState(null, '', location.pathname);
    try {
      await this.exchange({ token });
      return true;
    } catch {
      return false; // A used link in a tab that has a key already: the key decides.
    }
  }

  /** A link that is pasted into the address of an open page changes its fragment and does not load it again. */
  private async renew(): Promise<void> {
    if (await this.takeLink()) this.listen();
  }

  /** Runs a command once. Where the connection breaks before the answer, it is sent again with the same id. */
  async command<T = Record<string, unknown>>(name: string, argument: object = {}): Promise<T> {
    const body = { ...argument, id: newId() };
    for (let attempt = 1; ; attempt++) {
      try {
        const response = await this.post(`/api/commands/${name}`, body);
        return (await response.json()) as T;
      } catch (error) {
        const answered = error instanceof Refusal && !UNANSWERED.includes(error.status);
        if (answered || attempt === ATTEMPTS) throw error;
        await pause(300 * 1.6 ** attempt);
      }
    }
  }

  /** Sends a file to the open project, in pieces, at most MOST_BYTES; `sent` hears the share that has arrived. */
  async send(file: Blob, sent: (share: number) => void): Promise<void> {
    const piece = 768 * 1024;
    for (let offset = 0; offset < file.size || offset === 0; offset += piece) {
      await this.request(`/api/reference/${offset}`, {
        method: 'POST',
        headers: { 'Content-Type': 'application/octet-stream' },
        body: await file.slice(offset, offset + piece).arrayBuffer(),
      });
      sent(Math.min(1, (offset + piece) / Math.max(1, file.size)));
    }
  }

  /** The point of the exact mesh on a ray. */
  async pick(ray: Ray): Promise<Hit | null> {
    const response = await this.post('/api/pick', ray);
    return ((await response.json()) as { hit: Hit | null }).hit;
  }

  /** Where a plane cuts the exact mesh. */
  async cut(plane: { point_mm: Triple; normal: Triple }): Promise<Section> {
    return (await this.post('/api/section', plane)).json() as Promise<Section>;
  }

  async newLink(): Promise<string> {
    const response = await this.post('/api/links', {});
    return ((await response.json()) as { url: string }).url;
  }

  /** How tablets are let in; null where that is not offered. */
  async lan(): Promise<Lan | null> {
    try {
      return (await (await this.request('/api/lan', {})).json()) as Lan;
    } catch (error) {
      if (error instanceof Refusal && error.status === FORBIDDEN) return null;
      throw error;
    }
  }
  /** Lets tablets in at an address of the machine, or nobody any more. */
  async changeLan(wanted?: { address: string; encrypted: boolean }): Promise<Lan> {
    return (await (await this.post('/api/lan', wanted ?? {})).json()) as Lan;
  }

  async bytes(path: string): Promise<ArrayBuffer> {
    return (await this.request(path, {})).arrayBuffer();
  }

  async download(name: string): Promise<void> {
    const blob = await (await this.request(`/api/exports/${encodeURIComponent(name)}`, {})).blob();
    const anchor = document.createElement('a');
    anchor.href = URL.createObjectURL(blob);
    anchor.download = name;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(anchor.href), 10_000);
  }

  private async request(path: string, init: RequestInit): Promise<Response> {
    const headers = { ...(init.headers as Record<string, string>), Authorization: `Bearer ${this.key}` };
    ++this.unanswered;
    try {
      return await answerOf(await fetch(path, { ...init, headers }));
    } catch (error) {
      if (error instanceof Refusal && error.status === 401) this.set('refused');
      throw error;
    } finally {
      --this.unanswered;
    }
  }

  private listen(): void {
    if (this.socket) {
      this.socket.onclose = null;
      this.socket.close();
    }
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/api/live`);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    let refused = false;
    let opened = false;
    socket.onopen = () => {
      opened = true;
      this.unopened = 0;
      this.blocked = false;
      socket.send(JSON.stringify({ type: 'hello', key: this.key }));
    };
    socket.onmessage = (event) => {
      if (event.data instanceof ArrayBuffer) return this.pictured(event.data);
      const message = JSON.parse(event.data as string) as { type: string; operator: string; state: State };
      if (message.type !== 'state') return;
      this.patience = 500;
      this.state = message.state;
      this.operator = message.operator;
      if (this.link !== 'open' && this.layer !== 'none')
        socket.send(JSON.stringify({ type: 'show', layer: this.layer }));
      this.set('open');
    };
    socket.onclose = (event) => {
      refused = event.code === 1008;
      if (refused) return this.set('refused');
      this.set('lost');
      if (!opened) void this.lookForBlock();
      setTimeout(() => this.listen(), this.patience);
      this.patience = Math.min(8000, this.patience * 1.6);
    };
  }

  /** Some browsers ask no one about the certificate of a socket, and some proxies do not pass it on. */
  private async lookForBlock(): Promise<void> {
    if (++this.unopened < SOCKETS_TO_TRY) return;
    this.blocked = await this.request('/api/state', {}).then(
      () => true,
      () => false,
    );
    this.changed();
  }

  private set(link: Link): void {
    this.link = link;
    this.changed();
  }
}
