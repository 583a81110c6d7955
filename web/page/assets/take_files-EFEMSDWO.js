import{c as a,d as b}from"./chunk-JQOFPELW.js";import"./chunk-EOD2NTZK.js";import"./chunk-G4SOC24D.js";import"./chunk-SKAQTLI7.js";export{a as addFiles,b as chooseFor};
