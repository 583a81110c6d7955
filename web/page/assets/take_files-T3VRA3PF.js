import{c as a,d as b}from"./chunk-F2UZPITC.js";import"./chunk-YBCN3HMH.js";import"./chunk-SSOAZZRG.js";import"./chunk-SKAQTLI7.js";export{a as addFiles,b as chooseFor};
