import{c as a,d as b}from"./chunk-B7YIEDAE.js";import"./chunk-6KTYTA44.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
