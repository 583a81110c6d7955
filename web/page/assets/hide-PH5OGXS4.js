import{a,b,c}from"./chunk-LEWHXLNI.js";import"./chunk-RXPDOPUC.js";import"./chunk-SKAQTLI7.js";export{c as elementAt,b as isWithin,a as withoutElements};
