import{c as a,d as b}from"./chunk-3WTXFCP5.js";import"./chunk-ITDCAXWB.js";import"./chunk-TFNCRB62.js";import"./chunk-ULO32DJH.js";export{a as addFiles,b as chooseFor};
