import{c as a,d as b}from"./chunk-73AS7JVR.js";import"./chunk-E6GU3DH5.js";import"./chunk-NM5EJ3FV.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
