import{c as a,d as b}from"./chunk-KKW3TQMX.js";import"./chunk-EMICTDFZ.js";import"./chunk-V6QQA3OY.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
