import { render } from 'preact';
import { App } from './views/app.tsx';
import './style/base.css';
import './style/gallery.css';
import './style/viewer.css';
import './style/panel.css';
import '../../grade/report/view.css';
import './style/grade.css';
import './style/assignment.css';

render(<App />, document.getElementById('app') as HTMLElement);
