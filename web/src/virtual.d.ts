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
// The view of grades that the report of `farol grade` is made of, too.
declare module '*/grade/report/view.js' {
  interface Graded {
    id: string;
    name: string;
    identifier: string;
    points: number;
    most: number;
    passed: boolean;
    state?: string;
    tasks: ({ grade: object; references: () => string[]; pictures: () => string[] } | { failure: { code: string; message: string } })[];
  }
  interface GradesView {
    show(all: readonly Graded[]): void;
    choose(index: number, focus?: boolean): void;
  }
  function gradesView(places: { head: HTMLElement; body: HTMLElement; keys: EventTarget; chosen?: (one: Graded) => void }): GradesView;
}
