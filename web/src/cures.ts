// The cures of the error catalogue, taken from api/errors.md when the page is built.
import cures from 'virtual:cures';

export const cureOf = (code: string): string => cures[code] ?? '';
