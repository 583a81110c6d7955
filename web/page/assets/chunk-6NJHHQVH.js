<<<<<<<< HEAD:web/page/assets/chunk-MXGDT27R.js
import{j as e}from"./chunk-NM5EJ3FV.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
========
import{c as e}from"./chunk-VJMTGN2C.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
>>>>>>>> 6a6ccfe (web: page of the grade page):web/page/assets/chunk-6NJHHQVH.js
