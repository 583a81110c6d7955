import{c as a,d as b}from"./chunk-ZA4JS7ZO.js";import"./chunk-NEQALOKG.js";import"./chunk-TYZQW7BX.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
