import{c as a,d as b}from"./chunk-5A7BIQD3.js";import"./chunk-U25XNYVR.js";import"./chunk-35332W72.js";import"./chunk-SKAQTLI7.js";export{a as addFiles,b as chooseFor};
