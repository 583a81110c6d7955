// The scene language for completion: elements and attributes from api/scene.xsd, and what they
// mean from the tables of docs/scene-language.md.

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

export interface LanguageSchema {
  elements: ElementEntry[];
}

const attribute = (tag: string, name: string): string => new RegExp(`\\b${name}="([^"]*)"`).exec(tag)?.[1] ?? '';

/** The words of a simple type: "[cC][oO]" is a word in any case. */
function wordsOf(schema: string): Map<string, string[]> {
  const out = new Map<string, string[]>([['Flag', ['true', 'false']]]);
  for (const [, name = '', body = ''] of schema.matchAll(/<xs:simpleType name="(\w[^"]*)">([\s\S]*?)<\/xs:simpleType>/g)) {
    const patterns = [...body.matchAll(/<xs:pattern value="([^"]*)"/g)].map((match) => match[1] ?? '');
    if (name === 'Flag' || patterns.length === 0) continue;
    out.set(name, patterns.map((pattern) => pattern.replace(/\[(\w)\w\]/g, '$1')).filter((word) => /^[\w.-]+$/.test(word)));
  }
  return out;
}

interface Described {
  help: string;
  attributes: Map<string, string>; // canonical name -> meaning
  aliases: Set<string>;
}

/** "### `<light>` (also `<lamp>`)" with its table of attributes. */
function describe(page: string): Map<string, Described> {
  const out = new Map<string, Described>();
  for (const part of page.split(/^### /m).slice(1)) {
    const name = /^`<(\w+)>`/.exec(part)?.[1];
    if (!name) continue;
    const attributes = new Map<string, string>(), aliases = new Set<string>();
    for (const row of part.matchAll(/^\| `(\w+)` \|([^|]*)\|([^|]*)\|([^|]*)\|([^|]*)\|$/gm)) {
      const [, key = '', also = '', value = '', otherwise = '', meaning = ''] = row;
      const text = [meaning.trim(), value.trim(), otherwise.trim() && `default ${otherwise.trim()}`].filter(Boolean).join('; ');
      attributes.set(key, text.replaceAll('`', ''));
      for (const alias of also.matchAll(/`(\w+)`/g)) aliases.add(alias[1] ?? '');
    }
    const prose = part.split('\n').slice(1).find((line) => /^[A-Z]/.test(line)) ?? '';
    out.set(name.toLowerCase(), { help: prose.replaceAll('`', ''), attributes, aliases });
  }
  return out;
}

export function schemaOf(schema: string, page: string): LanguageSchema {
  const words = wordsOf(schema), described = describe(page);
  const types = new Map<string, { body: string }>();
  for (const [, name = '', body = ''] of schema.matchAll(/<xs:complexType name="(\w+)">([\s\S]*?)<\/xs:complexType>/g)) types.set(name, { body });
  const typeOf = new Map<string, string>(); // element -> type; aliases of an element have its type
  const childrenOf = (body: string): string[] => {
    const seen = new Set<string>(), out: string[] = [];
    for (const [tag] of body.matchAll(/<xs:element [^>]*>/g)) {
      const name = attribute(tag, 'name'), type = attribute(tag, 'type');
      if (seen.has(type)) continue; // another spelling of the one before
      seen.add(type);
      typeOf.set(name, type);
      out.push(name);
    }
    return out;
  };
  const roots = ['world', 'scene'];
  for (const name of roots) typeOf.set(name, 'World');
  const children = new Map([...types].map(([name, { body }]) => [name, childrenOf(body)]));
  const elements: ElementEntry[] = [];
  for (const [name, type] of typeOf) {
    const body = types.get(type)?.body ?? '';
    const known = described.get(name.toLowerCase()) ?? (type === 'World' ? described.get('world') : undefined);
    const seen = new Set<string>(), attributes: AttributeEntry[] = [];
    for (const [tag] of body.matchAll(/<xs:attribute [^>]*>/g)) {
      const key = attribute(tag, 'name'), values = words.get(attribute(tag, 'type'));
      if (seen.has(key.toLowerCase()) || known?.aliases.has(key)) continue;
      seen.add(key.toLowerCase());
      const help = known?.attributes.get(key);
      attributes.push({ name: key, ...(values ? { values } : {}), ...(help ? { help } : {}) });
    }
    // What the page documents comes first; the older spellings follow.
    attributes.sort((a, b) => Number(!a.help) - Number(!b.help));
    elements.push({
      name, children: children.get(type) ?? [], attributes,
      ...(roots.includes(name) ? { top: true } : {}), ...(known?.help ? { help: known.help } : {}),
    });
  }
  return { elements };
}
