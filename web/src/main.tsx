import { render } from 'preact';
import { App } from './views/app.tsx';
import { firstWords } from './words.ts';
import './style/base.css';
import './style/gallery.css';
import './style/viewer.css';
import './style/panel.css';
import './style/tree.css';
import './style/compare.css';
import './style/grade.css';
import './style/assignment.css';
import './style/touch.css';

void firstWords().then(() => render(<App />, document.getElementById('app') as HTMLElement));
