import{a,b,c}from"./chunk-H4QOKGAE.js";import"./chunk-RXPDOPUC.js";import"./chunk-ULO32DJH.js";export{c as elementAt,b as isWithin,a as withoutElements};
