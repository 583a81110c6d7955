import{c as a,d as b}from"./chunk-PNLXY77G.js";import"./chunk-U76HKAGB.js";import"./chunk-43AYE4DQ.js";import"./chunk-SKAQTLI7.js";export{a as addFiles,b as chooseFor};
