// Moodle's names of folders and files, and who is meant by a name in a table.
import type { GroupMember, Override, Submission } from './types.ts';

const moodle = /^((.{1,200})_([0-9]{1,18})_assignsubmission_[a-z]+(?:_|$))(.*)$/;

/** `Name_id_assignsubmission_file_` at the beginning of a name; empty where it has none. */
export const moodlePrefix = (name: string): string => (name.length <= 255 ? (moodle.exec(name)?.[1] ?? '') : '');

/** Who handed it in, by Moodle's names. */
export function studentOf(id: string): { name: string; identifier: string } {
  const found = id.length <= 255 ? moodle.exec(id) : null;
  return found ? { name: found[2] as string, identifier: `Participant ${found[3]}` } : { name: '', identifier: '' };
}

/** As names are compared: grade/report/overrides.cpp. */
export const folded = (text: string): string => text.normalize('NFD').toLowerCase().trim();

type Who = Pick<Submission, 'id' | 'name' | 'identifier'>;

/** Whether a name in a table means the submission: its name, the student's, or Moodle's identifier. */
export function isStudent(who: string, { id, name, identifier }: Who): boolean {
  const meant = folded(who);
  if (meant === '') return false;
  const number = identifier.replace(/^participant /i, '');
  return [id, name, ...(number ? [number, `Participant ${number}`] : [])].some((text) => folded(text) === meant);
}

/** The rows of a table that mean the submission. */
export const overridesOf = (all: readonly Override[], who: Who): Override[] => all.filter((row) => isStudent(row.student, who));

/** The members of a group that handed in together, else the student alone. */
export function membersOf(groups: readonly GroupMember[], who: Who): { name: string; identifier: string }[] {
  const members = groups.filter((row) => isStudent(row.submission, who)).map(({ name, identifier }) => ({ name, identifier }));
  return members.length > 0 ? members : [{ name: who.name, identifier: who.identifier }];
}
