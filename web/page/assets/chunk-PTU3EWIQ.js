<<<<<<< HEAD:web/page/assets/chunk-PTU3EWIQ.js
import{b as e}from"./chunk-2QZYHFGU.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
=======
<<<<<<<< HEAD:web/page/assets/chunk-E2KICB5Q.js
import{b as e}from"./chunk-OTVGJGUN.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
========
import{j as e}from"./chunk-JPOZMVBE.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
>>>>>>>> bf3220b (web: timeline with keys, frames and export; see-through; four languages):web/page/assets/chunk-N2LJTJC6.js
>>>>>>> fe9a0af (web: timeline with keys, frames and export; see-through; four languages):web/page/assets/chunk-E2KICB5Q.js
