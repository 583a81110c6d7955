import{c as a,d as b}from"./chunk-R4L5XDOV.js";import"./chunk-BYFHUMK6.js";import"./chunk-CTGLWXNA.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
