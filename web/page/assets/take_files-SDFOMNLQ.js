import{c as a,d as b}from"./chunk-ZSYAFXHI.js";import"./chunk-6GGBMRMQ.js";import"./chunk-JPOZMVBE.js";import"./chunk-L6JX62ME.js";import"./chunk-EMJR3EDO.js";export{a as addFiles,b as chooseFor};
