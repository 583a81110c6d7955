<<<<<<<< HEAD:web/page/assets/chunk-JX73GMTS.js
import{a}from"./chunk-5WKUK3DC.js";var l=0;function _(o,e,i,p,s,u){e||(e={});var n,t,r=e;if("ref"in r)for(t in r={},e)t=="ref"?n=e[t]:r[t]=e[t];var f={type:o,props:r,key:i,ref:n,__k:null,__:null,__b:0,__e:null,__c:null,constructor:void 0,__v:--l,__i:-1,__u:0,__source:s,__self:u};if(typeof o=="function"&&(n=o.defaultProps))for(t in n)r[t]===void 0&&(r[t]=n[t]);return a.vnode&&a.vnode(f),f}export{_ as a};
========
import{a}from"./chunk-V6QQA3OY.js";var l=0;function _(o,e,i,p,s,u){e||(e={});var n,t,r=e;if("ref"in r)for(t in r={},e)t=="ref"?n=e[t]:r[t]=e[t];var f={type:o,props:r,key:i,ref:n,__k:null,__:null,__b:0,__e:null,__c:null,constructor:void 0,__v:--l,__i:-1,__u:0,__source:s,__self:u};if(typeof o=="function"&&(n=o.defaultProps))for(t in n)r[t]===void 0&&(r[t]=n[t]);return a.vnode&&a.vnode(f),f}export{_ as a};
>>>>>>>> 1fe4fd4 (web: remove a submission, names in Latin-1; a class of 200 measured):web/page/assets/chunk-KNQXSIUZ.js
