import{k as e}from"./chunk-G4SOC24D.js";var r=e(!1),o=e(!1),t=e(!1);function s(){t.value=!0,o.value=!0}export{r as a,o as b,t as c,s as d};
