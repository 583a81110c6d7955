// The line to the server, as the answers show it: its round trip and its bandwidth.

/** Of one answer, from the browser's record of it. */
export interface Transfer {
  bytes: number; // of the body, as sent
  firstByteMs: number; // from the request, on an open connection, to the first byte
  transferMs: number; // from the first byte to the last
}

const kept = 4; // answers whose best is believed
const leastBytes = 16000; // smaller bodies come in one piece and show no bandwidth
const slowBytesPerMs = 600; // 4.8 Mbit/s: an exact image of a megapixel takes about a second
const farMs = 40;
const veryFarMs = 100; // slow until a bandwidth is known
const crawlBytesPerMs = 150; // slow at any distance

export class Line {
  private roundTrips: number[] = [];
  private bandwidths: number[] = [];

  /** `serverMs`: what the server spent on it. Small bodies show the round trip, for not every record has it in its first byte. */
  add({ bytes, firstByteMs, transferMs }: Transfer, serverMs: number): void {
    this.roundTrips = [...this.roundTrips, Math.max(0, firstByteMs + transferMs - serverMs)].slice(-kept);
    if (bytes >= leastBytes) this.bandwidths = [...this.bandwidths, bytes / Math.max(transferMs, 0.5)].slice(-kept);
  }

  get isKnown(): boolean {
    return this.roundTrips.length > 0;
  }

  /** 0 while it is not known. */
  get roundTripMs(): number {
    return this.roundTrips.length > 0 ? Math.min(...this.roundTrips) : 0;
  }

  /** The best of the last large answers: several at once share the line. Infinite while it is not known. */
  get bytesPerMs(): number {
    return this.bandwidths.length > 0 ? Math.max(...this.bandwidths) : Number.POSITIVE_INFINITY;
  }

  /** A busy machine makes a near server look slow, too: a slow line is also a long one, or very slow. */
  get isSlow(): boolean {
    if (this.bandwidths.length === 0) return this.roundTripMs > veryFarMs;
    return this.bytesPerMs < crawlBytesPerMs || (this.bytesPerMs < slowBytesPerMs && this.roundTripMs > farMs);
  }

  /** How many requests fill the line: those of a round trip, and the one that is coming in. */
  requestsFor(bytes: number, serverMs: number): number {
    const each = Math.max(bytes / this.bytesPerMs, serverMs, 25);
    return Math.min(5, Math.max(2, Math.ceil((this.roundTripMs + each) / each)));
  }
}
