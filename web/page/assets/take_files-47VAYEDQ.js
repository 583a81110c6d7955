import{c as a,d as b}from"./chunk-TF5NS62B.js";import"./chunk-R7YUV3SJ.js";import"./chunk-5WKUK3DC.js";import"./chunk-YXPABMPN.js";export{a as addFiles,b as chooseFor};
