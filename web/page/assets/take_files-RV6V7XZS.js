import{c as a,d as b}from"./chunk-2ZYK4QAB.js";import"./chunk-YU5WQ2A7.js";import"./chunk-KHLQ6CMQ.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
