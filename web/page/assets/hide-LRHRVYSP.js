import{a,b,c}from"./chunk-M4I3ERMV.js";import"./chunk-RXPDOPUC.js";import"./chunk-PXFBW63G.js";export{c as elementAt,b as isWithin,a as withoutElements};
