import{a as o}from"./chunk-PMRFXTL7.js";import s from"./document.schema.js";var r=o(s);export{r as a};
