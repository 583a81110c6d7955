// The token of a server that wants one for storing and deleting: asked for when the server says so,
// kept while this tab is open, and sent with what changes something.
import { signal } from '@preact/signals';

interface Question {
  sentence: string;
  answer(token: string | null): void;
}

/** What the dialog asks now; null: nothing. */
export const question = signal<Question | null>(null);

const key = 'farol.token';
let known: string | null = null; // where the browser keeps nothing

export function token(): string | null {
  try {
    return sessionStorage.getItem(key) ?? known;
  } catch {
    return known;
  }
}

function keep(given: string): void {
  known = given;
  try {
    sessionStorage.setItem(key, given);
  } catch {
    // It is asked for again after a reload.
  }
}

let asked: Promise<boolean> | null = null;

/** Asks for the token; false when the user gives none. Requests that wait for it share one dialog. */
export function askForToken(sentence: string): Promise<boolean> {
  asked ??= new Promise<string | null>((answer) => (question.value = { sentence, answer })).then((given) => {
    question.value = null;
    asked = null;
    if (given) keep(given);
    return given !== null && given !== '';
  });
  return asked;
}
