// What modules of the page set when they are loaded, where there is no page.
Object.assign(globalThis, { document: { documentElement: { lang: '' } } });
