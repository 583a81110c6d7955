/** Code -> fix, from the error catalogue: "### code" and then "**Fix:** ..." in its paragraph. */
export function curesOf(catalogue: string): Record<string, string> {
  const out: Record<string, string> = {};
  for (const part of catalogue.split(/^### /m).slice(1)) {
    const code = /^\S+/.exec(part)?.[0];
    const cure = /\*\*Fix:\*\*\s+([\s\S]*?)(?:\n\n|$)/.exec(part)?.[1];
    if (code && cure) out[code] = cure.replace(/\s+/g, ' ').replaceAll('`', '').trim();
  }
  return out;
}
