// A form for a document by its JSON schema. Fields have the names of the document's keys.
import type { ComponentChildren } from 'preact';
import type { Schema } from '../../grade/schema_check.ts';
import { t } from '../../words.ts';
import { Icon } from '../icons.tsx';

export interface FieldProps {
  name: string;
  path: string; // JSON pointer, for the labels of entries
  schema: Schema;
  value: unknown;
  usual?: unknown; // what holds where the document says nothing
  onChange: (value: unknown) => void; // undefined: the key goes
}

const isNullable = ({ type, enum: words }: Schema): boolean => [type ?? []].flat().includes('null') || Boolean(words?.includes(null));
const typeOf = ({ type }: Schema): string => [type ?? []].flat().find((one) => one !== 'null') ?? '';
const shown = (value: unknown): string => (value === undefined || value === null ? '' : String(value));

const Labelled = ({ name, help, children }: { name: string; help: string | undefined; children: ComponentChildren }) => (
  <label class="schema-field" title={help ?? ''}><span>{name}</span>{children}{help && <small class="note">{help}</small>}</label>
);

function NumberInput({ schema, value, usual, onChange, name }: FieldProps) {
  return <input type="number" step={typeOf(schema) === 'integer' ? 1 : 'any'} min={schema.minimum ?? ''} max={schema.maximum ?? ''} value={shown(value)} placeholder={shown(usual)} aria-label={name}
    onInput={(event) => {
      const text = event.currentTarget.value;
      onChange(text === '' || !Number.isFinite(Number(text)) ? undefined : Number(text));
    }} />;
}

function Words({ schema, value, usual, onChange, name }: FieldProps) {
  const isFlag = typeOf(schema) === 'boolean', words = isFlag ? ['true', 'false'] : (schema.enum ?? []).filter((one) => one !== null).map(String);
  const read = (text: string): unknown => (text === '' ? undefined : isFlag ? text === 'true' : ((schema.enum ?? []).find((one) => String(one) === text)));
  return (
    <select aria-label={name} value={shown(value)} onChange={(event) => onChange(read(event.currentTarget.value))}>
      <option value="" selected={value === undefined || value === null}>{usual === undefined || usual === null ? t('any') : t('default: {value}', { value: String(usual) })}</option>
      {words.map((word) => <option key={word} value={word} selected={shown(value) === word}>{word}</option>)}
    </select>
  );
}

/** Numbers, or names, with commas between. */
function Listed({ schema, value, onChange, name }: FieldProps) {
  const isNumber = typeOf(schema.items ?? {}) === 'number';
  return <input type="text" value={Array.isArray(value) ? value.join(', ') : ''} placeholder={(schema.items?.enum ?? []).slice(0, 3).join(', ')} aria-label={name}
    onChange={(event) => {
      const words = event.currentTarget.value.split(',').map((one) => one.trim()).filter(Boolean);
      onChange(words.length === 0 ? undefined : words.map((one) => (isNumber && Number.isFinite(Number(one)) ? Number(one) : one)));
    }} />;
}

function Entries({ schema, value, usual, onChange, name, path }: FieldProps) {
  const all = (Array.isArray(value) ? value : Array.isArray(usual) ? usual : []) as Record<string, unknown>[], items = schema.items ?? {};
  const blank = (): Record<string, unknown> => {
    const made: Record<string, unknown> = {};
    for (const key of items.required ?? []) made[key] = key === 'id' ? `${name}-${all.length + 1}` : key === 'text' ? t('What is asked for') : (items.properties?.[key]?.enum?.[0] ?? '');
    return made;
  };
  return (
    <fieldset class="entries"><legend>{name} <small class="note">{schema.description}</small></legend>
      {all.map((one, i) => (
        <details key={i} class="entry" open={all.length < 4}>
          <summary>{shown(one['id'] ?? one['name']) || `${i + 1}`}{one['text'] ? <span class="note"> {shown(one['text'])}</span> : null}</summary>
          <Members name={`${name} ${i + 1}`} path={`${path}/${i}`} schema={items} value={one} onChange={(changed) => onChange(all.map((other, j) => (j === i ? changed : other)))} />
          <button type="button" class="link" onClick={() => onChange(all.filter((_, j) => j !== i))}>{t('Remove {name}', { name: shown(one['id'] ?? one['name']) || `${name} ${i + 1}` })}</button>
        </details>
      ))}
      {all.length < (schema.maxItems ?? Infinity) && <button type="button" class="button small" onClick={() => onChange([...all, blank()])}><Icon name="plus" />{t('Add to {name}', { name })}</button>}
    </fieldset>
  );
}

/** Numbers by keys of any name. */
function ByKey({ schema, value, onChange, name }: FieldProps) {
  const all = (value ?? {}) as Record<string, number>, rule = schema.additionalProperties as Schema;
  return (
    <fieldset class="entries"><legend>{name} <small class="note">{schema.description}</small></legend>
      {Object.entries(all).map(([key, one]) => (
        <div key={key} class="by-key"><code>{key}</code><NumberInput name={key} path="" schema={rule} value={one} onChange={(changed) => onChange({ ...all, [key]: changed ?? 0 })} />
          <button type="button" class="link" onClick={() => onChange(Object.fromEntries(Object.entries(all).filter(([other]) => other !== key)))}>{t('Remove {name}', { name: key })}</button></div>
      ))}
      <label class="schema-field"><span>{t('Another code')}</span><input type="text" placeholder="texture.missing" onChange={(event) => {
        const key = event.currentTarget.value.trim();
        if (key) onChange({ ...all, [key]: all[key] ?? 1 });
        event.currentTarget.value = '';
      }} /></label>
    </fieldset>
  );
}

/** The keys of an object. */
export function Members({ schema, value, usual, onChange, path, only }: FieldProps & { only?: readonly string[] }) {
  const all = (value ?? {}) as Record<string, unknown>, defaults = (usual ?? {}) as Record<string, unknown>;
  const set = (key: string, changed: unknown): void => {
    const { [key]: _, ...rest } = all;
    onChange(changed === undefined ? rest : { ...all, [key]: changed });
  };
  const keys = Object.entries(schema.properties ?? {}).filter(([key]) => key !== '$schema' && (!only || only.includes(key)));
  return <div class="members">{keys.map(([key, rule]) => (
    <Field key={key} name={key} path={`${path}/${key}`} schema={rule} value={all[key]} usual={defaults[key]} onChange={(changed) => set(key, changed)} />
  ))}</div>;
}

function ObjectField(props: FieldProps) {
  const { schema, value, name, onChange } = props;
  if (value === undefined || value === null) {
    if (isNullable(schema)) return <button type="button" class="button small" title={schema.description ?? ''} onClick={() => onChange({})}><Icon name="plus" />{name}</button>;
  }
  return (
    <details class="entry" open={value !== undefined && value !== null}><summary>{name} <small class="note">{schema.description}</small></summary>
      <Members {...props} />
      {isNullable(schema) && <button type="button" class="link" onClick={() => onChange(undefined)}>{t('Remove {name}', { name })}</button>}
    </details>
  );
}

export function Field(props: FieldProps) {
  const { schema, name, value, onChange } = props, type = typeOf(schema);
  if (type === 'array') return schema.items?.type === 'object' ? <Entries {...props} /> : <Labelled name={name} help={schema.description}><Listed {...props} /></Labelled>;
  if (type === 'object') return schema.properties ? <ObjectField {...props} /> : <ByKey {...props} />;
  if (schema.enum || type === 'boolean') return <Labelled name={name} help={schema.description}><Words {...props} /></Labelled>;
  if (type === 'number' || type === 'integer') return <Labelled name={name} help={schema.description}><NumberInput {...props} /></Labelled>;
  return <Labelled name={name} help={schema.description}>
    <input type="text" maxLength={schema.maxLength ?? 200} value={shown(value)} placeholder={shown(props.usual)} onChange={(event) => onChange(event.currentTarget.value === '' ? undefined : event.currentTarget.value)} />
  </Labelled>;
}
