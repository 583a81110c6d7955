import{c as a,d as b}from"./chunk-ZZTJGV55.js";import"./chunk-HKFBGV3Y.js";import"./chunk-45K7QBPV.js";import"./chunk-6KTYTA44.js";export{a as addFiles,b as chooseFor};
