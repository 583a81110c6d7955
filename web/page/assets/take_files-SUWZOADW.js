import{c as a,d as b}from"./chunk-N54UQI2X.js";import"./chunk-C4GEKTK2.js";import"./chunk-4OJLYIEZ.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
