import{a,b,c}from"./chunk-CEQXNFUZ.js";import"./chunk-RXPDOPUC.js";import"./chunk-YXPABMPN.js";export{c as elementAt,b as isWithin,a as withoutElements};
