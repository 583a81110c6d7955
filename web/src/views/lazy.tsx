// Views that are loaded when they are first shown.
import type { ComponentType, FunctionComponent } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { t } from '../words.ts';

export function lazyView<Props extends object>(load: () => Promise<ComponentType<Props>>): FunctionComponent<Props> {
  let loaded: ComponentType<Props> | null = null;
  return function Lazy(props) {
    const [state, setState] = useState<'loading' | 'ready' | 'failed'>(loaded ? 'ready' : 'loading');
    useEffect(() => {
      if (loaded) return;
      load().then((view) => {
        loaded = view;
        setState('ready');
      }, () => setState('failed'));
    }, []);
    if (state === 'ready' && loaded) {
      const View = loaded as ComponentType<object>;
      return <View {...props} />;
    }
    return <p class={`note lazy ${state}`}>{state === 'failed' ? t('The server did not send this part of the page. Load the page again.') : t('Loading…')}</p>;
  };
}
