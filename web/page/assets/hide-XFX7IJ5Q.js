import{a,b,c}from"./chunk-3IRFOMJR.js";import"./chunk-RXPDOPUC.js";import"./chunk-3NWGMB6J.js";export{c as elementAt,b as isWithin,a as withoutElements};
