<<<<<<<< HEAD:web/page/assets/chunk-TR65ZCC5.js
import{k as e}from"./chunk-5WKUK3DC.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
========
import{k as e}from"./chunk-V6QQA3OY.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
>>>>>>>> 1fe4fd4 (web: remove a submission, names in Latin-1; a class of 200 measured):web/page/assets/chunk-D75KJ3Y2.js
