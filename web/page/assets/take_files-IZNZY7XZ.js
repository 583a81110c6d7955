import{c as a,d as b}from"./chunk-WI6K3IHF.js";import"./chunk-2FVG6PHI.js";import"./chunk-NHVM2EVB.js";import"./chunk-ULO32DJH.js";export{a as addFiles,b as chooseFor};
