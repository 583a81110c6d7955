import{c as a,d as b}from"./chunk-JMKZYVKK.js";import"./chunk-WJU5F2SU.js";import"./chunk-JGDR4J2V.js";import"./chunk-ULO32DJH.js";export{a as addFiles,b as chooseFor};
