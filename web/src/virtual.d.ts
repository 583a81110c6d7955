declare module 'virtual:cures' {
  const cures: Record<string, string>;
  export default cures;
}
declare module 'virtual:schema' {
  const schema: import('../derive/schema.ts').LanguageSchema;
  export default schema;
}
declare module '*.css';
