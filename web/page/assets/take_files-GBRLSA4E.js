import{c as a,d as b}from"./chunk-U4SLC5VO.js";import"./chunk-6KTYTA44.js";import"./chunk-L6JX62ME.js";import"./chunk-EMJR3EDO.js";export{a as addFiles,b as chooseFor};
