import{c as a,d as b}from"./chunk-4P3Q546Q.js";import"./chunk-I5SKYTOQ.js";import"./chunk-TAKZFUAO.js";import"./chunk-PXFBW63G.js";export{a as addFiles,b as chooseFor};
