import{c as a,d as b}from"./chunk-PG7P7QZL.js";import"./chunk-NQTPZILB.js";import"./chunk-ZWC3VXJE.js";import"./chunk-SKAQTLI7.js";export{a as addFiles,b as chooseFor};
