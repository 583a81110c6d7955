import{c as a,d as b}from"./chunk-ZF2OEOWT.js";import"./chunk-SD3RGCW2.js";import"./chunk-MLR6ANOR.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
