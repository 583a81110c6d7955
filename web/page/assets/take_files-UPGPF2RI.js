import{c as a,d as b}from"./chunk-DWCHU24B.js";import"./chunk-L6JX62ME.js";import"./chunk-EMJR3EDO.js";import"./chunk-6KTYTA44.js";export{a as addFiles,b as chooseFor};
