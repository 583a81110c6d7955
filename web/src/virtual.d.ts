// Documents of the project, each embedded by the server as a module of one text (cmake/web.cmake).
declare module 'document:errors' {
  const text: string;
  export default text;
}
declare module 'document:schema' {
  const text: string;
  export default text;
}
declare module '*.css';
// Files of grade/report and words of core/languages as texts (web/report_files.mjs).
declare module 'report:*' {
  const text: string;
  export default text;
}
