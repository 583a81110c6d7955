// The scene language for completion and inspector, from the reader's tables (api/schema.json).

export interface AttributeEntry {
  name: string;
  values?: string[];
  help?: string;
}

export interface ElementEntry {
  name: string;
  top?: boolean;
  children: string[];
  attributes: AttributeEntry[];
  help?: string;
}

interface AttributeRow {
  name: string;
  aliases?: string[];
  type: 'number' | 'integer' | 'flag' | 'text' | 'word';
  min?: number;
  max?: number;
  words?: string[][]; // each with its other spellings
  default?: string;
  meaning?: string;
}

interface ElementRow {
  name: string;
  aliases?: string[];
  summary?: string;
  children?: string[];
  attributes?: AttributeRow[];
}

const plain = (markdown: string): string => markdown.replaceAll('`', '');

function valueOf({ type, min, max, words }: AttributeRow): string {
  if (type === 'word') return (words ?? []).map(([word]) => word).join(', ');
  if (type === 'flag') return 'true, false';
  if (type === 'text') return 'text';
  const kind = type === 'integer' ? 'whole number' : 'number';
  if (min !== undefined && max !== undefined) return `${kind}, ${min} to ${max}`;
  return min === undefined ? kind : min > 0 ? `${kind}, over 0` : `${kind}, ${min} or more`;
}

function attributeEntry(row: AttributeRow): AttributeEntry {
  const values = row.type === 'flag' ? ['true', 'false'] : row.words?.flat().filter((word) => /^[\w.-]+$/.test(word));
  const help = [row.meaning, valueOf(row), row.default && `default ${row.default}`].filter(Boolean).join('; ');
  return { name: row.name, ...(values ? { values } : {}), help: plain(help) };
}

const rowsOf = (tables: string): ElementRow[] => (JSON.parse(tables) as { elements: ElementRow[] }).elements;

/** Every spelling of an element, or of an attribute of it; the usual one first. */
export function spellingsOf(tables: string): (element: string, attribute?: string) => readonly string[] {
  const rows = new Map(rowsOf(tables).map((row) => [row.name, row]));
  return (element, attribute) => {
    const owner = rows.get(element), row = attribute === undefined ? owner : owner?.attributes?.find(({ name }) => name === attribute);
    if (!row) throw new Error(`the scene language has no ${element} ${attribute ?? ''}`);
    return [row.name, ...(row.aliases ?? [])];
  };
}

/** Elements by each of their spellings. Of children the usual spelling is offered. */
export function schemaOf(tables: string): { elements: ElementEntry[] } {
  const rows = rowsOf(tables);
  // The elements of <colors> are written like the material of a model.
  const usual = new Map(rows.map(({ name, aliases }) => [name, name === 'namedColor' ? aliases?.[0] ?? name : name]));
  const elements: ElementEntry[] = [], seen = new Set<string>();
  for (const row of rows)
    for (const name of [row.name, row.name.toLowerCase(), ...(row.aliases ?? [])]) {
      if (name.toLowerCase() === 'namedcolor' || seen.has(name)) continue;
      seen.add(name);
      elements.push({
        name,
        children: (row.children ?? []).map((child) => usual.get(child) ?? child),
        attributes: (row.attributes ?? []).map(attributeEntry),
        ...(row.name === 'world' ? { top: true } : {}),
        ...(row.summary ? { help: plain(row.summary) } : {}),
      });
    }
  return { elements };
}
