// The browser of the page's tests. The headless shell is Chromium without its windows: the same engine for less than half
// of the processor's time.
import { existsSync } from 'node:fs';

export const chromiumPath = [process.env.FAROL_CHROMIUM, '/usr/bin/chromium-headless-shell', '/usr/bin/chromium'].find((path) => path && existsSync(path));
