import type { State } from './types';

const KEY = 'frangia-key';

/** A refusal of the server, in its words. */
export class Refusal extends Error {
  constructor(readonly status: number, sentence: string) {
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

export type Link = 'connecting' | 'open' | 'lost' | 'refused';

/**
 * The connection to the server. The launch token stands in the fragment of the address, which is never sent; it is
 * exchanged once for a key that only this origin's pages in this tab can read.
 */
export class Session {
  state: State | null = null;
  link: Link = 'connecting';
  private key: string | null = sessionStorage.getItem(KEY);
  private patience = 500;

  constructor(private readonly changed: () => void) {}

  async begin(): Promise<void> {
    const token = new URLSearchParams(location.hash.slice(1)).get('token');
    if (token) {
      history.replaceState(null, '', location.pathname);
      try {
        const response = await answerOf(
          await fetch('/api/session', {
            method: 'POST',
            headers: { 'Content-Type': 'application/json' },
            body: JSON.stringify({ token }),
          }),
        );
        this.key = ((await response.json()) as { key: string }).key;
        sessionStorage.setItem(KEY, this.key);
      } catch {
        // A used link in a tab that has a key already: the key decides.
      }
    }
    if (!this.key) return this.set('refused');
    this.listen();
  }

  async command<T = Record<string, unknown>>(name: string, argument: object = {}): Promise<T> {
    const response = await this.request(`/api/commands/${name}`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(argument),
    });
    return (await response.json()) as T;
  }

  async newLink(): Promise<string> {
    const response = await this.request('/api/links', {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: '{}',
    });
    return ((await response.json()) as { url: string }).url;
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
    try {
      return await answerOf(await fetch(path, { ...init, headers }));
    } catch (error) {
      if (error instanceof Refusal && error.status === 401) this.set('refused');
      throw error;
    }
  }

  private listen(): void {
    const socket = new WebSocket(`ws://${location.host}/api/live`);
    let refused = false;
    socket.onopen = () => socket.send(JSON.stringify({ type: 'hello', key: this.key }));
    socket.onmessage = (event) => {
      const message = JSON.parse(event.data as string) as { type: string; state: State };
      if (message.type !== 'state') return;
      this.patience = 500;
      this.state = message.state;
      this.set('open');
    };
    socket.onclose = (event) => {
      refused = event.code === 1008;
      if (refused) return this.set('refused');
      this.set('lost');
      setTimeout(() => this.listen(), this.patience);
      this.patience = Math.min(8000, this.patience * 1.6);
    };
  }

  private set(link: Link): void {
    this.link = link;
    this.changed();
  }
}
