import{c as a,d as b}from"./chunk-JFOHT6UW.js";import"./chunk-4YN4CV3S.js";import"./chunk-J5OQGHY6.js";import"./chunk-3NWGMB6J.js";export{a as addFiles,b as chooseFor};
