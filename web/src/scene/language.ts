// Spellings of the scene language, from the reader's tables.
import tables from 'document:schema';
import { spellingsOf } from '../../derive/schema.ts';

export const spellings = spellingsOf(tables);
