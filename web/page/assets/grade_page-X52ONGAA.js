import{a as pn,b as fn,c as gn,d as Ke,e as vt,f as Pe,g as yt,h as kt,i as wt,k as bn,l as hn}from"./chunk-FOECNS4F.js";import{b as mn}from"./chunk-ZCWX2WV6.js";import{a as un,c as cn,d as dn,e as ht}from"./chunk-QBVGNNOC.js";import{a as _e}from"./chunk-4FROGARH.js";import{C as ln,s as fe,v as an,w as se,y as on,z as bt}from"./chunk-JHPJA3CU.js";import{b as gt,d as Te,e as Yt,f as Zt,g as Qt,k as en,l as tn,p as nn,s as sn,u as K}from"./chunk-5JCVD3AG.js";import{a as r}from"./chunk-AS63WPSQ.js";import"./chunk-KVWACPON.js";import{m as rn,p as $e}from"./chunk-EOD2NTZK.js";import{b as S,d as pe,e as B,g as z,i as mt,j as Ut,k as y,l as j,m as Re,n as pt,o as ft,q as Xt,t as x,u as l,v as L,w as A}from"./chunk-G4SOC24D.js";var Xs=e=>e===null?"null":Array.isArray(e)?"array":Number.isInteger(e)?"integer":typeof e,Ys=e=>{let t=typeof e=="string"?e:JSON.stringify(e);return t.length>40?`${t.slice(0,40)}…`:t},Zs=e=>e.replaceAll("~","~0").replaceAll("/","~1");function vn({minimum:e,maximum:t},n){return e!==void 0&&t!==void 0?l("{kind} from {least} to {most}",{kind:n,least:e,most:t}):n}function Qs(e){return e.enum?l("one of {words}",{words:e.enum.map(n=>n===null?"null":String(n)).join(", ")}):[e.type??[]].flat().map(n=>({number:vn(e,l("a number")),integer:vn(e,l("a whole number")),string:l("a text"),boolean:l("true or false"),object:l("an object"),array:l("a list"),null:"null"})[n]??n).join(` ${l("or")} `)}var er=50;function xt(e,t,n,s){if(s.length>=er)return;let i=(c,d=n)=>void s.push({pointer:d,message:c}),o=()=>i(l('is "{value}"; expected {expected}',{value:Ys(e),expected:Qs(t)}));if(t.enum){t.enum.includes(e)||o();return}let a=[t.type??[]].flat(),u=Xs(e);if(a.length>0&&!a.includes(u)&&!(u==="integer"&&a.includes("number")))return o();if(typeof e=="number")(e<(t.minimum??-1/0)||e>(t.maximum??1/0))&&o();else if(typeof e=="string")e.length<(t.minLength??0)&&i(l("is empty; write a text")),e.length>(t.maxLength??1/0)&&i(l("is longer than {most} letters",{most:t.maxLength??0}));else if(Array.isArray(e)){let{minItems:c=0,maxItems:d=1/0,items:m}=t;(e.length<c||e.length>d)&&i(l("has {count} entries; expected {least} to {most}",{count:e.length,least:c,most:d})),t.uniqueItems&&new Set(e.map(p=>JSON.stringify(p))).size<e.length&&i(l("has a duplicated entry")),m&&e.slice(0,d).forEach((p,g)=>xt(p,m,`${n}/${g}`,s))}else if(u==="object"){let c=t.properties??{},{additionalProperties:d}=t;for(let m of t.required??[])Object.hasOwn(e,m)||i(l('needs "{key}"',{key:m}));for(let[m,p]of Object.entries(e)){let g=Object.hasOwn(c,m)?c[m]:d,f=`${n}/${Zs(m)}`;g===!1?i(l("is no key of a rubric; expected one of {words}",{words:Object.keys(c).filter(h=>h!=="$schema").join(", ")}),f):typeof g=="object"&&xt(p,g,f,s)}}}function yn(e,t){let n=[];return xt(e,t,"",n),n}function kn(e,t){let n=t.split("/").slice(1).map(d=>d.replaceAll("~1","/").replaceAll("~0","~")),s=0,i=/\s*("(?:[^"\\]|\\.)*"|[{}[\],:]|[^\s{}[\],:"]+)/y,o=()=>{i.lastIndex=s;let d=i.exec(e);return s=d?i.lastIndex:e.length,d?.[1]??""},a=()=>{let d=s,m=o();return s=d,m},u=()=>{let d=0;do{let m=o();if(m==="")return;d+=m==="{"||m==="["?1:m==="}"||m==="]"?-1:0}while(d>0)};for(let d of n){let m=o(),p=!1;for(let g=0;!p;++g){let f=a();if(f===""||f==="}"||f==="]")break;if(f===","){o(),--g;continue}if(m==="{"){let h=JSON.parse(o());o(),p=h===d}else p=String(g)===d;p||u()}if(!p)break}let c=a();return e.slice(0,e.indexOf(c||`
`,s)).split(`
`).length}var Ct=e=>[...e.requirements,...e.manual].reduce((t,n)=>t+n.points,0);function E(e){let t=e.points-Ct(e);return Math.abs(t)<1e-6?0:t}var Oe=e=>typeof e=="object"&&e!==null&&!Array.isArray(e)?e:{},St=e=>Array.isArray(e)?e.map(Oe):[],ge=e=>Object.fromEntries(Object.entries(e).filter(([,t])=>t!==null));function Mt(e,t){let n=structuredClone(t.defaultRubric),s=ge(e),i={...n,title:"Rubric",...s};i.picture={...Oe(n.picture),...ge(Oe(s.picture))};let o=Oe(s.penalties),a=Oe(n.penalties);i.penalties={...a,...ge(o)},i.criteria=St(i.criteria).map(c=>{let d=t.gradeMeasures.find(({name:w})=>w===c.measure),{weight:m=1,tolerance:p,limit:g,perFinding:f}=d??{};return{...{weight:m,...p===void 0?{perFinding:f}:{tolerance:p,limit:g}},...ge(c)}}),i.requirements=St(i.requirements).map(c=>({points:1,...ge(c)})),i.manual=St(i.manual).map(c=>({points:1,...ge(c)}));let u=Ct(i);return u>0&&!("points"in s)&&!("criteria"in s)&&(i.points=u),i}function tr(e,t){let n=[],s=new Set(t.gradeMeasures.map(({name:o})=>o)),i=new Set;e.criteria.forEach(({measure:o,tolerance:a,limit:u},c)=>{i.has(o)&&n.push({pointer:`/criteria/${c}/measure`,message:l('is duplicated: "{name}"',{name:o})}),i.add(o),a!==void 0&&u!==void 0&&a>=u&&n.push({pointer:`/criteria/${c}/tolerance`,message:l("is not below the limit, {limit}",{limit:u})})});for(let o of["requirements","manual"])e[o].forEach(({id:a},u)=>{s.has(a)&&n.push({pointer:`/${o}/${u}/id`,message:l('is duplicated: "{name}"',{name:a})}),s.add(a)});return e.criteria.reduce((o,a)=>o+a.weight,0)<=0&&n.push({pointer:"/criteria",message:l("has no weight above 0")}),E(e)<0&&n.push({pointer:"/points",message:l("is {points}; requirements and parts marked by hand have {sum} together",{points:e.points,sum:Ct(e)})}),n}function nr(e,t){let n=/\bline (\d+)/.exec(t)?.[1],s=/\bposition (\d+)/.exec(t)?.[1];return n?Number(n):e.slice(0,s?Number(s):e.length).split(`
`).length}function Je(e,t){let n;try{n=JSON.parse(e)}catch(i){let o=i.message;return{document:null,problems:[{pointer:"",line:nr(e,o),message:l("is no JSON: {reason}",{reason:o})}]}}let s=yn(n,t.rubric);return s.length===0&&(s=tr(Mt(n,t),t)),{document:n,problems:s.map(i=>({...i,line:kn(e,i.pointer)}))}}var Rt=e=>`${JSON.stringify(e,null,2)}
`;var sr=["models","transforms","textures","materials","lights","camera","animation"],Tt=["models","transforms","textures","materials"],wn=.02,xn=3,rr=45,ir=4,ar=1.5,F=e=>Math.round(e*100)/100,Pt=e=>Math.min(1,Math.max(0,e));function re(e){return Array.isArray(e)?`[${e.map(re).join()}]`:typeof e!="object"||e===null?JSON.stringify(e)??"null":`{${Object.entries(e).sort(([t],[n])=>t<n?-1:1).map(([t,n])=>`${JSON.stringify(t)}:${re(n)}`).join()}}`}function Sn(e){let{title:t,points:n,weight:s,passMark:i,strictness:o,criteria:a,penalties:u,manual:c,$schema:d,...m}=e;return re({...m,requirements:e.requirements.map(({points:p,...g})=>g),compared:E(e)>0})}function or(e,{spoils:t,places:n}){let s=e.most-e.least,i=Math.max(1,n.length),o=e.least+s*Math.sqrt(Pt(t/i)),a=e.least+s*Math.sqrt(Pt(t));return i>1?Math.max(a,ar*o):o}var We=e=>sr.includes(e);function Cn(e,{lights:t,camera:n,moves:s}){return e.weight<=0?!1:e.measure==="lights"?t>0:e.measure==="camera"?n:e.measure==="animation"?s:!0}function Tn(e,t,n,s){let i=e.criteria.find(({measure:o})=>o===t.measure)?.measured;return i===void 0||t.tolerance===void 0||t.limit===void 0?null:n*(1-Pt(s*(i-t.tolerance)/(t.limit-t.tolerance)))*e.present}function lr(e,t,n){let s=n.gradeMeasures.filter(({pictures:u})=>u),i=t.criteria.filter(({measure:u,weight:c})=>c>0&&s.some(({name:d})=>d===u));i.length===0&&(i=s.filter(({weight:u})=>u>1).map(u=>({...u,measure:u.name})));let o=i.reduce((u,c)=>u+c.weight,0),a=[];for(let u of i){let c=E(t)*u.weight/o,d=Tn(e,u,c,t.strictness);if(d===null)return null;a.push({measure:u.measure,points:d,most:c})}return{criteria:a,causes:e.findings.map(()=>0),unexplained:0,sum:a.reduce((u,c)=>u+c.points,0)}}var $t=()=>({models:0,transforms:0,textures:0,materials:0,lights:0,camera:0,animation:0});function ur(e,t,n,s){let i=t.criteria.filter(v=>Cn(v,s)),o=E(t),a=n.defaultRubric.criteria.filter(v=>Cn(v,s)),u=i.reduce((v,k)=>v+k.weight,0),c=a.reduce((v,k)=>v+k.weight,0),d=$t(),m=$t(),p=$t();for(let{measure:v,weight:k,perFinding:O=.5}of i){if(!We(v))continue;let _=k/u,ne=(a.find(me=>me.measure===v)?.weight??0)/c;d[v]=o*_,m[v]=d[v]*e.present,p[v]=Math.min(ir,ne>0?_/ne:1)*O/.5}let g=v=>v/100*o*t.strictness,f=v=>{let k=Tt.reduce((_,ne)=>_+m[ne],0);if(k<=0||v<=0)return 0;let O=Math.min(1,v/k);for(let _ of Tt)m[_]*=1-O;return O*k},h=(v,k)=>{let O=Math.min(k,m[v]);return m[v]-=O,O},w=e.diagnostics.some(({code:v,severity:k})=>v==="xml.unclosed"&&k==="error"),R=e.findings.map(v=>{let k=n.gradeKinds.find(({code:me})=>me===v.code);if(!k||!We(k.criterion)||!v.seen||k.most<=0||w&&k.code==="group.parent")return 0;let O=k.criterion,_=g(or(k,v)*p[O]);if(Tt.includes(O)){let me=h(O,_);return F(me+(p[O]>0?f(_-me):0))}let ne=_*e.present;return F(h(O,k.code==="light.missing"?Math.max(ne,d[O]*e.present/s.lights):ne))}),q=e.unexplained.share,dt=q>wn?F(f(g(xn+(rr-xn)*Math.sqrt(Math.min(1,q-wn))))):0,de=[];for(let v of i){let k=o*v.weight/u,O=We(v.measure)?m[v.measure]:Tn(e,v,k,t.strictness);if(O===null)return null;de.push({measure:v.measure,points:O,most:k})}return{criteria:de,causes:R,unexplained:dt,sum:de.reduce((v,k)=>v+k.points,0)}}function Mn(e,t,n,s){return E(t)<=0?{criteria:[],causes:e.findings.map(()=>0),unexplained:0,sum:0}:s.isScene?ur(e,t,n,s):lr(e,t,n)}function Rn(e,t,n){let{warning:s,most:i,codes:o}=t.penalties,a=0;for(let{code:u,severity:c}of e.diagnostics)a+=o[u]??(c==="info"?0:s);for(let{code:u,seen:c}of e.findings)c&&n.gradeKinds.some(d=>d.code===u)&&(a+=o[u]??0);return Math.min(a,i)}function cr({diagnostics:e}){let t=e.filter(({severity:n})=>n==="error");return t.some(({code:n})=>n.startsWith("xml."))?40:Math.min(18,6*t.filter(({code:n})=>n.startsWith("scene.")).length)}function dr(e,t,n,s){if([t,n].some(({penalties:a})=>Object.keys(a.codes).some(u=>!s.gradeKinds.some(c=>c.code===u))))return re(t.penalties)===re(n.penalties)&&t.points===n.points?e.penalty:null;let o=e.penalty-Rn(e,t,s)>.005?cr(e):0;return F(Rn(e,n,s)+o/100*n.points)}function mr(e,t){let n=e.found??0,s=e.needed??0,i=t.atMost,o=s>0?Math.min(1,n/s):0;return!t.each&&i&&n>i&&(o*=i/n),o>=1||t.partial!==!1&&o>0?F(t.points*o):0}function pr(e,t){let n=o=>t.criteria.some(({measure:u,weight:c})=>u===o&&c>0)?[e.criteria.some(({measure:u,kind:c})=>u===o&&!c)]:[!1,!0],s=e.findings.some(({code:o})=>o==="light.missing"),i=[];for(let o of n("lights"))for(let a of n("camera"))for(let u of n("animation"))for(let c=o?1:0;c<=(o&&s?16:o?1:0);++c)i.push({isScene:!0,lights:c,camera:a,moves:u});return[...i,{isScene:!1,lights:0,camera:!1,moves:!1}]}var Fe=(e,t,n=.0151)=>Math.abs(e-t)<=n;function fr(e,t){let n=t.criteria.filter(({kind:s})=>!s);return e.criteria.length===n.length&&Fe(e.unexplained,t.unexplained.points)&&e.criteria.every((s,i)=>s.measure===n[i]?.measure&&Fe(s.points,n[i].points)&&Fe(s.most,n[i].most))&&t.findings.every(({criterion:s,points:i},o)=>!We(s)||Fe(i,e.causes[o]??0))}function $n(e,t,n,s){if(re(t)===re(n))return e;if(Sn(t)!==Sn(n))return null;let i=n.manual.map(({id:f,text:h,points:w})=>({measure:f,kind:"manual",text:h,state:"open",points:0,most:F(w),reason:l("A person marks this.")}));if(e.refused)return{...e,most:n.points,criteria:[...e.criteria.filter(({kind:f})=>f!=="manual"),...i]};let o=dr(e,t,n,s),a=pr(e,t).filter(f=>{let h=Mn(e,t,s,f);return h!==null&&fr(h,e)}).map(f=>Mn(e,n,s,f)),[u]=a;if(!u||o===null||!a.every(f=>f!==null&&Fe(f.sum,u.sum,.004)))return null;let c=u.criteria.map(({measure:f,points:h,most:w})=>{let R=e.criteria.find(de=>de.measure===f&&!de.kind),q={points:F(h),most:F(w)},dt=R?.measured===void 0||q.points===R.points?R?.reason??"":l("{share} % differs: {points} of {most} points.",{share:F(100*R.measured),...q});return{...R?.measured===void 0?{}:{measured:R.measured},measure:f,...q,reason:dt}}),d=new Map(n.requirements.map(f=>{let h=e.criteria.find(({kind:w,measure:R})=>w==="requirement"&&R===f.id);return[f.id,h&&{...h,points:mr(h,f),most:F(f.points)}]}));if([...d.values()].some(f=>f===void 0))return null;for(let f of d.values())f&&c.push(f);c.push(...i);let m=e.findings.map((f,h)=>{let w=d.get(f.criterion);return{...f,points:w?F(w.most-w.points):u.causes[h]??0}}),p=u.sum+[...d.values()].reduce((f,h)=>f+(h?.points??0),0),g=F(Math.max(0,p-o));return{...e,points:g,most:n.points,passed:g>=n.points*n.passMark/100,penalty:o,criteria:c,findings:m,unexplained:{...e.unexplained,points:u.unexplained}}}var Pn=(e,t)=>e.toLowerCase()===t.toLowerCase();function gr({code:e,message:t},n){return{state:"graded",points:0,most:n,passed:!1,refused:!0,visible:!1,present:0,penalty:0,unexplained:{points:0,share:0},reason:{code:e,message:t},criteria:[],findings:[],diagnostics:[],views:[]}}function br(e,t,n,{points:s,passMark:i}){let o=vt(n,t).filter(({task:d,criterion:m})=>(d!==""||m!=="")&&(d===""||Pn(d,e.task)));if(o.length===0||!e.grade&&!e.failure)return e;let a=structuredClone(e.grade??gr(e.failure,s)),u=null,c=a.points;a.overrides=[];for(let{criterion:d,mark:m,comment:p}of o)if(a.overrides.push({...d?{criterion:d}:{},...m===null?{}:{mark:m},...p?{comment:p}:{}}),m!==null){if(d===""){u=Math.min(m,s);continue}for(let g of a.criteria){if(!Pn(g.measure,d))continue;let f=Math.min(m,g.most);c+=f-g.points,g.points=f,g.kind==="manual"&&(g.state="marked",g.reason=p)}}return c=F(u??Math.min(s,Math.max(0,c))),u!==null&&(a.refused=!1,a.state="graded"),{task:e.task,state:e.state,grade:{...a,points:c,passed:!a.refused&&c>=s*i/100}}}function On(e,t,n,s){let i=n[0],o=t.map((m,p)=>br(m,e,s,n[p])),a=0,u=0,c=!1;o.forEach(({grade:m},p)=>{let g=n[p];u+=g.weight,m&&(a+=g.weight*m.points/g.points,c=c||!m.refused)});let d={submission:e,points:u>0?F(i.points*a/u):0,most:i.points,passed:!1,graded:c,overridden:!1,comments:[],tasks:o};d.passed=c&&d.points>=i.points*i.passMark/100;for(let{task:m,criterion:p,mark:g,comment:f}of vt(s,e))m!==""||p!==""||(g!==null&&(d.points=Math.min(g,d.most),d.graded=d.overridden=!0,d.passed=d.points>=d.most*i.passMark/100),f&&d.comments.push(f));return d}var He=({tasks:e})=>e.every(({grade:t,failure:n})=>t||n),Ve=({overridden:e,tasks:t})=>e||t.some(({grade:n})=>n?.overrides);var Ne="grade/",Le=y("kept");async function ze(e,t){let n=await un(Ne+e,t);return n!=="kept"&&(Le.value=n),n==="kept"}var Fn=e=>ze("class",e),Nn=()=>ht(`${Ne}class`),be=class{constructor(t){this.folder=t;this.held=new Map}async set(t,n){await ze(`${this.folder}/${t}`,n)?this.held.delete(t):this.held.set(t,n)}async get(t){return this.held.get(t)??ht(`${Ne}${this.folder}/${t}`)}async delete(t){this.held.delete(t),await ze(`${this.folder}/${t}`,null)}clear(){this.held.clear()}},ie=new be("file"),Be=new be("reference"),Y=new be("images"),Z=new be("expected"),Ln=(e,t)=>ze(`result/${e}`,t),Bn=()=>cn(`${Ne}result/`);async function jn(){for(let t of[ie,Be,Y,Z])t.clear();let e=await dn(Ne);return Le.value="kept",e}var Ue=null;function Gn(){return Ue??=import("./document.schema.js").then(e=>JSON.parse(e.default)),Ue.catch(()=>Ue=null),Ue}var Q=(e,t)=>`${e}
${t}`;var vr=2,J=y(null),b=y([]),C=y([]),N=y([]),H=y([]),oe=y("placeholder"),W=y(new Map),he=y(new Set),ye=y(""),ae=y(!0),Xe=new Map,le=j(()=>b.value.map(({name:e})=>b.value.length>1?e:"")),In=new Map;function En(e,t){let n=In.get(e);return n||In.set(e,n=e?Mt(JSON.parse(e),t):{...t.defaultRubric}),n}var T=j(()=>J.value?b.value.map(e=>En(e.rubric?.text??"",J.value)):[]),An=new WeakMap;function yr(e,t,n){let s=An.get(e);if(s?.rubric===t)return s.grade;let i=e.grade?$n(e.grade,En(e.rubric,n),t,n):null;return An.set(e,{rubric:t,grade:i}),i}var ke=(e,t)=>e.reference!==null||E(t)<=0;function Dn(e,t){let n=b.value[t],s=Q(n.name,e.id),i=W.value.get(s),o=le.value[t]??"",a=he.value.has(s);if(!i)return{task:o,state:a?"grading":"waiting"};if(i.failure)return{task:o,state:a?"grading":"done",failure:i.failure};let u=yr(i,T.value[t],J.value),c=i.grade;return{task:o,state:a?"grading":u?"done":"stale",grade:u??c}}var $=j(()=>T.value.length===0?[]:C.value.map(e=>On(e,b.value.map((t,n)=>Dn(e,n)),T.value,N.value))),Nt=j(()=>C.value.flatMap(e=>b.value.flatMap((t,n)=>{let s=Dn(e,n);return s.state==="waiting"||s.state==="stale"?[{submission:e,at:n}]:[]}))),we=j(()=>$.value.reduce((e,t)=>e+t.tasks.filter(({state:n})=>n==="stale").length,0)),qn=j(()=>C.value.length*b.value.length),ve=y(null);Re(()=>{let e={tasks:b.value.map(({name:t,reference:n,rubric:s})=>({name:t,reference:n&&{name:n.name,fileName:n.fileName},rubric:s})),submissions:[...C.value],overrides:[...N.value],groups:[...H.value],missing:oe.value};Ut(()=>ae.value)||Fn(e)});async function _n(){if(!ae.value)return;J.value=await Gn();let e=await Nn();if(e){let t=await Bn(),n=await Promise.all(e.tasks.map(async({name:s,reference:i,rubric:o})=>{let a=i&&await Be.get(s);return{name:s,rubric:o,reference:i&&a?{...i,file:a}:null}}));mt(()=>{[b.value,C.value,N.value,H.value]=[n,e.submissions,e.overrides,e.groups],[oe.value,W.value]=[e.missing,t]})}ae.value=!1}function Ye(e,t){let n=new Map(W.value);t?n.set(e,t):n.delete(e),W.value=n,Ln(e,t)}var je=e=>{for(let t of[...W.value.keys()].filter(e))Ye(t,null),Y.delete(t)};async function Lt(e){let t=new Set(e.map(({id:n})=>n));for(let{id:n,file:s}of e)await ie.set(n,s);je(n=>t.has(n.slice(n.indexOf(`
`)+1))),C.value=[...C.value.filter(({id:n})=>!t.has(n)),...e.map(({file:n,...s})=>s)].sort((n,s)=>wt(n.id,s.id))}async function Ft(e){Xe.delete(e),await Promise.all([Be.delete(e),Z.delete(e)])}async function Ze(e,t){let n=new Set(e.map(({name:a})=>a)),s=b.value;if(!t)for(let{name:a}of s)n.has(a)||Ft(a);let i=e.map(a=>({...a,rubric:a.rubric??s.find(({name:u})=>u===a.name)?.rubric??(e.length===1&&s.length===1&&!t?s[0]?.rubric??null:null)}));for(let{name:a,reference:u}of i)await Ft(a),u&&await Be.set(a,u.file);let o=t&&s.length===1;je(a=>o||!t||n.has(a.slice(0,a.indexOf(`
`)))),b.value=t?[...s.filter(({name:a})=>!n.has(a)),...i].sort((a,u)=>wt(a.name,u.name)):i}function Ge(e,t){b.value=b.value.map((n,s)=>s===e?{...n,rubric:t}:n)}function Kn(e){je(t=>b.value.length===2||t.startsWith(`${e}
`)),b.value=b.value.filter(t=>t.name!==e),Ft(e)}function Jn(e,t){let n=i=>Ke(i.student,t)&&i.task.toLowerCase()===e.task.toLowerCase()&&i.criterion===e.criterion,s=N.value.filter(i=>!n(i));N.value=e.mark===null&&e.comment.trim()===""?s:[...s,{...e,student:t.id}]}function Wn(e){je(t=>t.slice(t.indexOf(`
`)+1)===e),C.value=C.value.filter(t=>t.id!==e),ie.delete(e)}function Qe(){je(()=>!0)}async function Hn(){Bt(),ae.value=!0,Xe.clear(),mt(()=>{[b.value,C.value,N.value,H.value]=[[],[],[],[]],[W.value,ye.value,oe.value]=[new Map,"","placeholder"]});let e=await jn();return ae.value=!1,e}var Ot=e=>{let[t="",n=""]=e.split(",",2);return new Blob([Uint8Array.from(atob(n),s=>s.charCodeAt(0))],{type:/:(.*?);/.exec(t)?.[1]??"image/jpeg"})};function kr(e){let t=[],n=[],s=e.views.map(({picture:i,heat:o,expected:a,...u})=>(t.push({picture:i?Ot(i):null,heat:o?Ot(o):null}),n.push(a?Ot(a):null),u));return{grade:{...e,views:s},images:t,expected:n}}var wr=(e,t,n)=>/^rubric\.|^grade\.(no|needless)-reference$/.test(e.code)||e.status<500&&e.status!==413&&e.findings[0]?.file===t.reference?.fileName&&n.fileName!==t.reference?.fileName,Vn=null;async function xr(e,t,n){let s=Q(t.name,e.id),i=t.rubric?.text??"",o=E(T.value[b.value.indexOf(t)])>0,a=b.value.filter(h=>h!==t).map(({name:h})=>h.replaceAll(","," ")).join(),u=await ie.get(e.id);if(!u)return Ye(s,{rubric:i,failure:{code:"grade.lost",message:l("The browser no longer has this file. Add it again.")}});let c=new FormData;c.append("submission",u,e.fileName),t.reference&&o&&c.append("reference",t.reference.file,t.reference.fileName),i&&c.append("rubric",new Blob([i],{type:"application/json"}),"rubric.json");let d=`v1/grade?${Qt({pictures:Xe.get(t.name)===i?1:2,missing:oe.value,...a?{task:t.name,others:a}:{}})}`,m=await Yt(()=>Te(d,{method:"POST",body:c,signal:n})),{grade:p,images:g,expected:f}=kr(await m.json());f.some(h=>h)&&(Xe.set(t.name,i),await Z.set(t.name,f)),!(!C.value.includes(e)||!b.value.some(h=>h.name===t.name&&h.reference===t.reference))&&(await Y.set(s,g),Ye(s,{grade:p,rubric:i}))}async function Sr(e,t,n){let s=Q(t.name,e.id);he.value=new Set([...he.value,s]);try{await xr(e,t,n.signal)}catch(i){if(n.signal.aborted)return;let o=sn(i).map(a=>nn(a)).join(" ");i instanceof gt&&!wr(i,t,e)?Ye(s,{rubric:t.rubric?.text??"",failure:{code:i.code,message:o}}):(ye.value=i instanceof gt?l("The task “{name}” cannot be graded: {reason}",{name:t.name,reason:o}):o,n.abort())}finally{he.value=new Set([...he.value].filter(i=>i!==s))}}async function et(){let e=Nt.value.filter(({at:i})=>ke(b.value[i],T.value[i])).map(({submission:i,at:o})=>({submission:i,name:b.value[o]?.name}));if(ve.value||e.length===0)return;let t=Vn=new AbortController,n=e.length;ye.value="",ve.value={done:0,all:n};let s=async()=>{for(let i=e.shift();i&&!t.signal.aborted;i=e.shift()){let o=b.value.find(({name:a})=>a===i?.name);o&&await Sr(i.submission,o,t),t.signal.aborted||(ve.value={done:n-e.length-he.value.size,all:n})}};await Promise.all(Array.from({length:vr},s)),ve.value=null}function Bt(){Vn?.abort()}var xe=y(null),ue=y({}),Ie=()=>void(xe.value=new Map($.value.filter(({graded:e})=>e).map(e=>[e.submission.id,e.points])));function zn(){[xe.value,ue.value]=[null,{}]}var Cr={"own camera":x("own camera"),"from the side":x("from the side"),"from above":x("from above")};function Mr(e){let[,t="",n]=/^(.*?)(?: at ([\d.]+) s)?$/.exec(e)??[],s=Cr[t];return s?n===void 0?l(s):l("{camera} at {seconds} s",{camera:l(s),seconds:A(Number(n))}):e}function Rr(e,t,n){let[s,i]=pe(null);return B(()=>{let o=!1;return Promise.all([Z.get(e),Y.get(t)]).then(([a,u])=>{o||i({expected:a??[],images:u??[]})}),()=>o=!0},[e,t,n.views]),s}function jt(e){let[t,n]=pe("");return B(()=>{if(!e)return n("");let s=URL.createObjectURL(e);return n(s),()=>URL.revokeObjectURL(s)},[e]),t}function Tr({given:e,expected:t}){let[n,s]=pe(50),i=o=>{if(!(o.buttons&1))return;let{left:a,width:u}=o.currentTarget.getBoundingClientRect();s(Math.min(100,Math.max(0,Math.round(100*(o.clientX-a)/u))))};return r("div",{class:"slider",children:[r("div",{class:"compare",onPointerDown:o=>{o.preventDefault(),o.currentTarget.setPointerCapture(o.pointerId),i(o)},onPointerMove:i,children:[r("img",{src:t,alt:l("Reference")}),r("img",{class:"over",src:e,alt:l("Submission"),style:{clipPath:`inset(0 ${100-n}% 0 0)`}}),r("hr",{style:{left:`${n}%`}}),r("span",{class:"left",children:l("Submission")}),r("span",{class:"right",children:l("Reference")})]}),r("input",{type:"range",min:"0",max:"100",value:n,"aria-label":l("Share of the submission that is shown"),onInput:o=>s(Number(o.currentTarget.value))})]})}var tt=({src:e,name:t})=>e?r("figure",{children:[r("img",{src:e,alt:t}),r("figcaption",{children:t})]}):null,Ae=e=>A(100*e,{maximumFractionDigits:1});function $r(e){let{difference:t,flip:n,ssim:s,coverage:i,depth:o,normals:a}=e;return[t!==void 0&&l("{share} % of the image differs",{share:Ae(t)}),n&&l("FLIP {mean}, 95th percentile {percentile}",{mean:A(n.mean),percentile:A(n.p95)}),s!==void 0&&`SSIM ${A(s)}`,i!==void 0&&l("objects elsewhere {share} %",{share:Ae(i)}),o!==void 0&&l("other depth {share} %",{share:Ae(o)}),a!==void 0&&l("other normals {share} %",{share:Ae(a)})].filter(u=>u).join(" · ")}var Un={side:x("Side by side"),slider:x("Slider"),difference:x("Difference")};function Pr({loaded:e,grade:t,at:n,mode:s}){let i=t.views[n],o=e.expected[n]??null,a=e.images[n],u=jt(o),c=jt(a?.picture??o),d=jt(a?.heat??null);return r(S,{children:[s==="slider"&&u&&c?r(Tr,{given:c,expected:u}):s==="difference"&&d?r("div",{class:"one",children:r(tt,{src:d,name:l("Difference: black none, white most")})}):r("div",{class:"side",children:[r(tt,{src:u,name:l("Reference")}),r(tt,{src:c,name:l("Submission")}),s==="side"&&r(tt,{src:d,name:l("Difference: black none, white most")})]}),r("p",{class:"note",children:o&&!a?.picture&&!d?l("The images are equal."):$r(i)})]})}function Xn({task:e,resultKey:t,grade:n}){let s=Rr(e,t,n),[i,o]=pe("side"),a=n.views.reduce((m,p,g)=>(p.difference??0)>(n.views[m]?.difference??0)?g:m,0),[u,c]=pe(a);B(()=>c(a),[t]);let d=n.views[u]?u:a;return n.views.length===0||!s?null:r("section",{class:"images","aria-label":l("Images"),children:[r("div",{class:"choices",role:"group","aria-label":l("View"),children:n.views.map((m,p)=>r("button",{type:"button","aria-pressed":p===d,onClick:()=>c(p),children:[Mr(m.name),m.difference!==void 0&&r("span",{class:"note",children:[" ",m.difference?`${Ae(m.difference)} %`:l("equal")]})]},m.name))}),r("div",{class:"choices",role:"group","aria-label":l("Comparison"),children:Object.keys(Un).map(m=>r("button",{type:"button","aria-pressed":m===i,onClick:()=>o(m),children:l(Un[m])},m))}),r(Pr,{loaded:s,grade:n,at:d,mode:i})]})}var Yn=["passed","failed","not graded","waiting","by hand"],Gt={key:"name",up:!0,words:"",state:"",cause:"",least:"",most:""};function Or(){try{return{...Gt,...JSON.parse(pt("grade.list")??"{}")}}catch{return Gt}}var P=y(Or()),ee=y(pt("grade.chosen")),Se=y(0);Re(()=>void ft("grade.list",JSON.stringify(P.value)));Re(()=>void ft("grade.chosen",ee.value));var It=j(()=>!!(P.value.words||P.value.state||P.value.cause||P.value.least||P.value.most)),Zn=()=>void(P.value={...Gt,key:P.value.key,up:P.value.up});function Qn(e){let{key:t,up:n}=P.value;P.value={...P.value,key:e,up:t===e?!n:e==="name"||e==="cause"||e==="result"}}var Ee=({submission:e})=>e.name||e.id;function Ce(e){return He(e)?e.graded?e.passed?"passed":"failed":"not graded":"waiting"}function Fr({grade:e,failure:t}){if(t||!e)return t?.message??"";if(e.refused)return e.reason?.message??"";let s=e.findings.filter(({points:a})=>a>0).sort((a,u)=>u.points-a.points)[0]??e.findings.find(({code:a})=>a.endsWith(".missing"));if(s)return s.message;let i=e.penalty>0?e.diagnostics.find(({severity:a})=>a==="error")??e.diagnostics[0]:void 0;return i?i.message:e.criteria.filter(a=>a.points<a.most).sort((a,u)=>u.most-u.points-(a.most-a.points))[0]?.reason??""}function nt({tasks:e}){let t=({grade:n,failure:s})=>s||n?.refused?-1:n?n.points/n.most:1;return[...e].sort((n,s)=>t(n)-t(s)).map(Fr).find(n=>n!=="")??""}var es=({tasks:e})=>e.flatMap(({grade:t,failure:n})=>[...n?[n.code]:[],...t?.reason?[t.reason.code]:[],...(t?.findings??[]).filter(({points:s,code:i})=>s>0||i.endsWith(".missing")).map(({code:s})=>s),...(t?.diagnostics??[]).filter(({severity:s})=>s==="error").map(({code:s})=>s)]),ts=j(()=>{let e=new Map;for(let t of $.value)for(let n of new Set(es(t)))e.set(n,(e.get(n)??0)+1);return[...e].sort(([t,n],[s,i])=>i-n||t.localeCompare(s))}),Nr=e=>[e.submission.id,e.submission.name,e.submission.identifier,Ce(e),nt(e),...e.comments,...e.tasks.flatMap(({grade:t})=>(t?.findings??[]).map(({message:n,code:s})=>`${n} ${s}`))].join(" ").toLowerCase();function Lr(e,{words:t,state:n,cause:s,least:i,most:o}){if((n==="by hand"?!Ve(e):n!==""&&Ce(e)!==n)||s!==""&&!es(e).includes(s))return!1;if(i!==""||o!==""){if(!e.graded)return!1;let u=100*e.points/e.most;if(i!==""&&u<Number(i)||o!==""&&u>Number(o))return!1}let a=t===""?"":Nr(e);return t.toLowerCase().split(/\s+/).filter(Boolean).every(u=>a.includes(u))}function Br(e,t){if(t==="mark")return e.graded?e.points:-1;if(t==="result")return Ce(e);if(t==="cause")return nt(e).toLowerCase();if(t==="name")return Ee(e).toLowerCase();let n=e.tasks[Number(t)]?.grade;return n&&!n.refused?n.points/n.most:-1}var D=j(()=>{let{key:e,up:t}=P.value;return $.value.filter(n=>Lr(n,P.value)).map(n=>({mark:n,value:Br(n,e)})).sort((n,s)=>{let i=typeof n.value=="string"?n.value.localeCompare(String(s.value)):n.value-Number(s.value);return(t?i:-i)||n.mark.submission.id.localeCompare(s.mark.submission.id)}).map(({mark:n})=>n)}),st=j(()=>$.value.find(({submission:e})=>e.id===ee.value)??null);function De(e){let t=D.value,n=t.findIndex(({submission:i})=>i.id===ee.value),s=t[Math.min(t.length-1,Math.max(0,n<0?0:n+e))];s&&(ee.value=s.submission.id)}var ns=1024*1024;function ss(e){let[t,n]=e;if(t===255&&n===254)return new TextDecoder("utf-16le").decode(e);if(t===254&&n===255)return new TextDecoder("utf-16be").decode(e);try{return new TextDecoder("utf-8",{fatal:!0}).decode(e)}catch{return new TextDecoder("windows-1252").decode(e)}}function jr(e,t){let n=t.replace(/^.*\//,"");for(let s of[i=>i===t,i=>i.endsWith(`/${t}`),i=>i.replace(/^.*\//,"")===n]){let i=e.findIndex(({path:o})=>s(o));if(i>=0)return i}return-1}async function rs(e,t,n){if(!pn(t)){if(e.size>ns)throw new Error(l("The document is larger than 1 MiB"));return{path:t,text:ss(new Uint8Array(await e.arrayBuffer()))}}let i=await fn(e);if(!i)throw new Error(l("This page does not open such an archive (7z, rar): unpack it"));let o=jr(i,n),a=i[o];if(!a)throw new Error(l("The submission has no file “{file}”",{file:n}));return{path:a.path,text:ss(await a.read(ns))}}var rt=200,qe=y(null);async function is(e,t,n){let s={submission:e.id,path:t??e.fileName,lines:[],line:n,from:0};try{let i=await ie.get(e.id);if(!i)throw new Error(l("The browser no longer has this file. Add it again."));let{path:o,text:a}=await rs(i,e.fileName,t??e.fileName);qe.value={...s,path:o,lines:a.split(/\r\n|\r|\n/),from:Math.max(0,n-1-rt),problem:""}}catch(i){qe.value={...s,problem:i.message}}}function as({submission:e}){let t=qe.value,n=z(null),s=z(null),i=t?.submission===e.id;if(B(()=>{if(!i||!n.current)return;let u=s.current;u&&(n.current.scrollTop=u.offsetTop-n.current.clientHeight/2),n.current.focus({preventScroll:!0}),n.current.scrollIntoView({block:"nearest"})},[t]),!t||!i)return null;let o=Math.min(t.lines.length,t.line+rt),a=u=>void(qe.value={...t,from:Math.max(0,u)});return r("section",{class:"source","aria-label":l("Document {path}",{path:t.path}),children:[r("div",{class:"source-head",children:[r("b",{children:t.path}),r("span",{class:"space"}),r(se,{icon:"close",label:l("Close the document"),onClick:()=>qe.value=null})]}),t.problem?r("p",{class:"problem",children:t.problem}):r("div",{class:"lines",ref:n,tabIndex:0,role:"region","aria-label":l("Line {line} of {path}",{line:t.line,path:t.path}),children:[t.from>0&&r("button",{type:"button",class:"link",onClick:()=>a(t.from-rt),children:l("Earlier lines")}),r("ol",{start:t.from+1,children:t.lines.slice(t.from,Math.max(o,t.from+2*rt)).map((u,c)=>{let d=t.from+c+1,m=d===t.line;return r("li",{value:d,...m?{ref:s,class:"here","aria-current":"true"}:{},children:r("code",{children:u||" "})},d)})})]})]})}var os={passed:x("passed"),failed:x("failed"),"not graded":x("not graded"),waiting:x("waiting"),"by hand":x("changed by hand")},M=e=>A(e,{maximumFractionDigits:2});function Gr(e){let t=e.filter(a=>Ce(a)!=="waiting"),n=t.filter(a=>a.graded).map(a=>a.points).sort((a,u)=>a-u),s=[L(e.length,"{count} submission","{count} submissions")],i=n.length>>1;t.length>0&&s.push(L(t.filter(a=>a.passed).length,"{count} passed","{count} passed"));let o=t.filter(a=>!a.graded).length;if(o>0&&s.push(L(o,"{count} not graded","{count} not graded")),n.length>0){let a=n.length%2?n[i]:(n[i-1]+n[i])/2;s.push(l("median {median} of {most} points",{median:M(a),most:M(e[0]?.most??0)}))}return s.join(", ")}function ls(){let e=P.value,t=s=>void(P.value={...e,...s}),n=(s,i)=>r("label",{class:"field",children:[r("span",{children:i}),r("input",{type:"number",min:"0",max:"100",step:"any",value:e[s],onInput:o=>t({[s]:o.currentTarget.value})})]});return r("div",{class:"filters",role:"search","aria-label":l("Filters"),children:[r("label",{class:"field grow",children:[r("span",{children:l("Filter")}),r("input",{id:"filter",type:"search",value:e.words,placeholder:l("name, cause, comment"),autocomplete:"off",onInput:s=>t({words:s.currentTarget.value})})]}),r(bt,{label:l("State"),value:e.state,onChange:s=>t({state:s}),choices:[["",l("all")],...Yn.map(s=>[s,l(os[s])])]}),r(bt,{label:l("Cause"),value:e.cause,onChange:s=>t({cause:s}),choices:[["",l("all")],...ts.value.map(([s,i])=>[s,`${s} (${i})`])]}),n("least",l("From %")),n("most",l("To %")),It.value&&r("button",{type:"button",class:"link",onClick:Zn,children:l("Show all")})]})}function Ir({task:{task:e,grade:t,failure:n,state:s}}){let i=n||t?.refused?"–":t?M(t.points):"";return r("td",{"data-task":e,class:s==="stale"?"figure stale":"figure",children:[s==="grading"?"…":i,s==="stale"&&r("span",{class:"hidden",children:[" ",l("by an earlier rubric")]})]})}function Ar({one:e}){let t=xe.value?.get(e.submission.id);if(t===void 0||!e.graded||Math.abs(e.points-t)<.005)return null;let n=e.points-t;return r("small",{class:n>0?"good":"bad",children:[n>0?"+":"−",M(Math.abs(n))]})}function Er({one:e,isFirst:t}){let n=Ce(e),s=e.submission.id===ee.value,i=z(null);B(()=>{s&&(i.current?.closest("tr")?.scrollIntoView({block:"nearest"}),document.activeElement?.closest("#list tbody")&&i.current?.focus({preventScroll:!0}))},[s]);let o=e.tasks.some(d=>d.state==="stale"),a=e.tasks.some(d=>d.state==="grading"),u=nt(e),c=s||t&&ee.value===null?0:-1;return r("tr",{"aria-current":s?"true":void 0,onClick:()=>ee.value=e.submission.id,children:[r("td",{children:[r("button",{ref:i,type:"button",class:"plain",tabIndex:c,children:Ee(e)}),e.submission.name&&r("div",{class:"note",children:e.submission.identifier})]}),r("td",{class:o?"figure stale":"figure",children:[e.graded?M(e.points):"–"," ",r(Ar,{one:e})]}),e.tasks.length>1&&e.tasks.map(d=>r(Ir,{task:d},d.task)),r("td",{class:n==="passed"?"good":n==="waiting"?"note":"bad",children:[a?l("grading…"):l(os[n]),Ve(e)&&r("span",{class:"by-hand",title:l("changed by hand"),children:[r("span",{"aria-hidden":"true",children:" ✎"}),r("span",{class:"hidden",children:[" ",l("changed by hand")]})]})]}),r("td",{class:"cause",children:u?r("span",{title:u,children:u}):n==="passed"&&e.points===e.most&&r("span",{class:"note",children:l("as the reference")})})]})}function us(){let{key:e,up:t}=P.value,n=le.value,s=[["name",l("Submission")],["mark",l("Mark of {most}",{most:M($.value[0]?.most??0)})],...n.length>1?n.map((o,a)=>[String(a),o]):[],["result",l("Result")],["cause",l("First cause")]],i=D.value[0];return r("section",{id:"list","aria-label":l("Submissions"),children:[r("p",{id:"summary",role:"status",children:[Gr($.value),It.value?` · ${l("{count} shown",{count:D.value.length})}`:""]}),r("div",{class:"scroll",tabIndex:-1,children:r("table",{children:[r("thead",{children:r("tr",{children:s.map(([o,a])=>r("th",{scope:"col","aria-sort":e!==o?"none":t?"ascending":"descending",children:r("button",{type:"button",onClick:()=>Qn(o),children:a})},o))})}),r("tbody",{children:D.value.map(o=>r(Er,{one:o,isFirst:o===i},o.submission.id))})]})}),D.value.length===0&&r("p",{class:"note",children:l("No submission matches.")})]})}function Dr({submission:e,file:t,line:n}){return n?r("button",{type:"button",class:"link line",onClick:()=>void is(e,t,n),children:l("line {line}",{line:n})}):null}var At=12;function Et({submission:e,places:t}){let n=t.filter(({line:s})=>s);return r(S,{children:[n.slice(0,At).map((s,i)=>r(Dr,{submission:e,file:s.file,line:s.line},i)),n.length>At&&r("span",{class:"note",children:[" ",l("and {count} more",{count:n.length-At})]})]})}var cs=({text:e})=>e?r("pre",{tabIndex:0,children:e.split(`
`).filter(Boolean).map((t,n)=>/^\d+ > /.test(t)?r("b",{children:t},n):`${t}
`)}):null;function qr(e){return e.points>0?`−${M(e.points)}`:e.seen===!1?l("costs nothing: it cannot be seen"):e.code.endsWith(".missing")?l("earns nothing"):l("costs nothing")}function _r({submission:e,causes:t}){return t.length===0?null:r("section",{"aria-label":l("Causes"),children:[r("h3",{children:l("Causes")}),r("ul",{class:"causes",children:t.map((n,s)=>r("li",{children:[n.message," ",r("span",{class:n.points>0?"bad":"note",children:qr(n)})," ",r(Et,{submission:e,places:n.places}),r(cs,{text:n.excerpt})]},s))})]})}function Kr({submission:e,all:t}){if(t.length===0)return null;let n=new Map;for(let s of t)n.set(s.severity+s.message,[...n.get(s.severity+s.message)??[],s]);return r("section",{"aria-label":l("The document"),children:[r("h3",{children:l("The document")}),r("ul",{class:"causes",children:[...n.values()].map((s,i)=>{let[o]=s;return r("li",{children:[r("span",{class:o.severity==="error"?"bad":"note",children:[o.severity==="error"?l("error"):o.severity==="warning"?l("warning"):l("note"),":"]})," ",o.message," ",r(Et,{submission:e,places:s}),r(cs,{text:o.excerpt})]},i)})})]})}function Jr(e,t,n){return N.value.filter(i=>Ke(i.student,e)&&i.task.toLowerCase()===t.toLowerCase()&&i.criterion===n.toLowerCase()).at(-1)??{mark:null,comment:""}}function Dt({submission:e,task:t,criterion:n,most:s,program:i,label:o}){let a=Jr(e,t,n),u=c=>Jn({...a,...c,task:t,criterion:n.toLowerCase()},e);return r(S,{children:[r("input",{type:"number",min:"0",max:s,step:"any",class:"mark-field",value:a.mark??"",placeholder:i,"aria-label":l("Mark for {part}",{part:o}),onChange:c=>{let d=c.currentTarget.value,m=Number(d);d===""?u({mark:null}):m>=0&&u({mark:Math.min(m,s)}),c.currentTarget.value=d===""||!(m>=0)?"":String(Math.min(m,s))}}),r("input",{type:"text",class:"comment-field",maxLength:2e3,value:a.comment,placeholder:l("Comment"),"aria-label":l("Comment on {part}",{part:o}),onChange:c=>u({comment:c.currentTarget.value})})]})}var Wr={met:()=>l("met"),"partly met":()=>l("partly met"),"not met":()=>l("not met"),open:()=>l("to be marked"),marked:()=>l("marked")};function Hr({submission:e,task:t,one:n}){let s=n.most>0?100*n.points/n.most:0;return r("li",{children:[r("div",{class:"criterion",children:[r("b",{children:n.measure}),n.kind!=="manual"&&r("span",{class:"bar","aria-hidden":"true",children:r("i",{style:{width:`${s}%`}})}),r("span",{class:"figure",children:[n.state==="open"?"–":M(n.points)," / ",M(n.most)]})]}),r("p",{class:"note",children:[n.text&&r(S,{children:[n.text," ",r("strong",{class:n.state==="met"||n.state==="marked"?"good":n.state==="open"?"note":"bad",children:Wr[n.state??""]?.()})," "]}),n.reason," ",r(Et,{submission:e,places:n.state==="met"?n.matches??[]:n.misses??[]})]}),r("div",{class:"by-person",children:r(Dt,{submission:e,task:t,criterion:n.measure,most:n.most,program:M(n.points),label:n.measure})})]})}function Vr({submission:e,task:t,at:n}){let{grade:s,failure:i,state:o}=t,a=T.value[n],u=Q(b.value[n]?.name??"",e.id);if(!s&&!i)return r("p",{class:"note",children:o==="grading"?l("grading…"):l("waiting")});let c=s&&!s.refused&&s.findings.length===0&&s.diagnostics.length===0&&s.points===s.most;return r(S,{children:[o==="stale"&&r("p",{class:"warning",children:l("By an earlier rubric: the new one asks the service to render again.")}),i&&r("p",{class:"bad",children:[i.message,i.code?` [${i.code}]`:""]}),s?.refused&&r("p",{class:"bad",children:l("Not graded: {reason}",{reason:s.reason?.message??""})}),s?.similarity!==void 0&&r("p",{children:l("The image shows {share} % of the reference.",{share:M(100*s.similarity)})}),c&&r("p",{class:"good",children:l("Nothing was found that differs.")}),s&&r(Xn,{task:b.value[n]?.name??"",resultKey:u,grade:s},u),s&&r(_r,{submission:e,causes:s.findings}),s&&s.unexplained.points>0&&r("p",{class:"bad",children:l("Unexplained: the images still differ when all of this is corrected (−{points}).",{points:M(s.unexplained.points)})}),s&&r(Kr,{submission:e,all:s.diagnostics}),r(as,{submission:e}),r("section",{"aria-label":l("Points"),children:[r("h3",{children:l("Points")}),r("ul",{class:"criteria",children:[s?.criteria.map(d=>r(Hr,{submission:e,task:t.task,one:d},d.measure)),b.value.length>1&&a&&r("li",{children:[r("div",{class:"criterion",children:[r("b",{children:l("All of {task}",{task:t.task})}),r("span",{class:"figure",children:[M(s?.points??0)," / ",M(a.points)]})]}),r("div",{class:"by-person",children:r(Dt,{submission:e,task:t.task,criterion:"",most:a.points,program:M(s?.points??0),label:t.task})})]})]}),s&&s.penalty>0&&r("p",{class:"bad",children:l("Diagnostics cost {points} points.",{points:M(s.penalty)})})]})]})}function zr({one:e}){return r("section",{class:"total","aria-label":l("The whole mark"),children:[r("h3",{children:l("The whole mark")}),r("div",{class:"by-person",children:r(Dt,{submission:e.submission,task:"",criterion:"",most:e.most,program:M(e.points),label:l("the submission")})})]})}function ds(){let e=st.value,t=le.value,n=Math.min(Se.value,t.length-1),s=z(null);if(B(()=>void(s.current&&(s.current.scrollTop=0)),[e?.submission.id]),!e)return r("section",{id:"detail","aria-label":l("Details"),children:r("p",{class:"note",children:l("Choose a submission: click it, or use the arrow keys; / goes to the filter.")})});let i=e.tasks[n],o=D.value.findIndex(({submission:a})=>a.id===e.submission.id)+1;return r("section",{id:"detail","aria-label":l("Details"),ref:s,children:[r("header",{class:"detail-head",children:[r("div",{children:[r("h2",{children:Ee(e)}),r("p",{class:"note",children:[e.submission.identifier,e.submission.id].filter(Boolean).join(" · ")})]}),r("strong",{class:e.passed?"good":"bad",children:e.graded?l("{points} of {most} points",{points:M(e.points),most:M(e.most)}):l("no mark")}),r("div",{class:"steps",children:[r(se,{icon:"up",label:l("Previous submission"),keys:"K",disabled:o<=1,onClick:()=>De(-1)}),r(se,{icon:"down",label:l("Next submission"),keys:"J",disabled:o===D.value.length,onClick:()=>De(1)})]})]}),t.length>1&&r("div",{class:"choices",role:"group","aria-label":l("Task"),children:t.map((a,u)=>r("button",{type:"button","aria-pressed":u===n,onClick:()=>Se.value=u,children:a},a))}),i&&r(Vr,{submission:e.submission,task:i,at:n},`${e.submission.id} ${n}`),r(zr,{one:e}),r("p",{children:r("button",{type:"button",class:"link",onClick:()=>Wn(e.submission.id),children:l("Remove this submission")})})]})}var ms=({type:e,enum:t})=>[e??[]].flat().includes("null")||!!t?.includes(null),at=({type:e})=>[e??[]].flat().find(t=>t!=="null")??"",U=e=>e==null?"":String(e),it=({name:e,help:t,children:n})=>r("label",{class:"schema-field",title:t??"",children:[r("span",{children:e}),n,t&&r("small",{class:"note",children:t})]});function ps({schema:e,value:t,usual:n,onChange:s,name:i}){return r("input",{type:"number",step:at(e)==="integer"?1:"any",min:e.minimum??"",max:e.maximum??"",value:U(t),placeholder:U(n),"aria-label":i,onInput:o=>{let a=o.currentTarget.value;s(a===""||!Number.isFinite(Number(a))?void 0:Number(a))}})}function Ur({schema:e,value:t,usual:n,onChange:s,name:i}){let o=at(e)==="boolean",a=o?["true","false"]:(e.enum??[]).filter(c=>c!==null).map(String),u=c=>c===""?void 0:o?c==="true":(e.enum??[]).find(d=>String(d)===c);return r("select",{"aria-label":i,value:U(t),onChange:c=>s(u(c.currentTarget.value)),children:[r("option",{value:"",selected:t==null,children:n==null?l("any"):l("default: {value}",{value:String(n)})}),a.map(c=>r("option",{value:c,selected:U(t)===c,children:c},c))]})}function Xr({schema:e,value:t,onChange:n,name:s}){let i=at(e.items??{})==="number";return r("input",{type:"text",value:Array.isArray(t)?t.join(", "):"",placeholder:(e.items?.enum??[]).slice(0,3).join(", "),"aria-label":s,onChange:o=>{let a=o.currentTarget.value.split(",").map(u=>u.trim()).filter(Boolean);n(a.length===0?void 0:a.map(u=>i&&Number.isFinite(Number(u))?Number(u):u))}})}function Yr({schema:e,value:t,usual:n,onChange:s,name:i,path:o}){let a=Array.isArray(t)?t:Array.isArray(n)?n:[],u=e.items??{},c=()=>{let d={};for(let m of u.required??[])d[m]=m==="id"?`${i}-${a.length+1}`:m==="text"?l("What is asked for"):u.properties?.[m]?.enum?.[0]??"";return d};return r("fieldset",{class:"entries",children:[r("legend",{children:[i," ",r("small",{class:"note",children:e.description})]}),a.map((d,m)=>r("details",{class:"entry",open:a.length<4,children:[r("summary",{children:[U(d.id??d.name)||`${m+1}`,d.text?r("span",{class:"note",children:[" ",U(d.text)]}):null]}),r(ot,{name:`${i} ${m+1}`,path:`${o}/${m}`,schema:u,value:d,onChange:p=>s(a.map((g,f)=>f===m?p:g))}),r("button",{type:"button",class:"link",onClick:()=>s(a.filter((p,g)=>g!==m)),children:l("Remove {name}",{name:U(d.id??d.name)||`${i} ${m+1}`})})]},m)),a.length<(e.maxItems??1/0)&&r("button",{type:"button",class:"button small",onClick:()=>s([...a,c()]),children:[r(K,{name:"plus"}),l("Add to {name}",{name:i})]})]})}function Zr({schema:e,value:t,onChange:n,name:s}){let i=t??{},o=e.additionalProperties;return r("fieldset",{class:"entries",children:[r("legend",{children:[s," ",r("small",{class:"note",children:e.description})]}),Object.entries(i).map(([a,u])=>r("div",{class:"by-key",children:[r("code",{children:a}),r(ps,{name:a,path:"",schema:o,value:u,onChange:c=>n({...i,[a]:c??0})}),r("button",{type:"button",class:"link",onClick:()=>n(Object.fromEntries(Object.entries(i).filter(([c])=>c!==a))),children:l("Remove {name}",{name:a})})]},a)),r("label",{class:"schema-field",children:[r("span",{children:l("Another code")}),r("input",{type:"text",placeholder:"texture.missing",onChange:a=>{let u=a.currentTarget.value.trim();u&&n({...i,[u]:i[u]??1}),a.currentTarget.value=""}})]})]})}function ot({schema:e,value:t,usual:n,onChange:s,path:i,only:o}){let a=t??{},u=n??{},c=(m,p)=>{let{[m]:g,...f}=a;s(p===void 0?f:{...a,[m]:p})},d=Object.entries(e.properties??{}).filter(([m])=>m!=="$schema"&&(!o||o.includes(m)));return r("div",{class:"members",children:d.map(([m,p])=>r(ei,{name:m,path:`${i}/${m}`,schema:p,value:a[m],usual:u[m],onChange:g=>c(m,g)},m))})}function Qr(e){let{schema:t,value:n,name:s,onChange:i}=e;return n==null&&ms(t)?r("button",{type:"button",class:"button small",title:t.description??"",onClick:()=>i({}),children:[r(K,{name:"plus"}),s]}):r("details",{class:"entry",open:n!=null,children:[r("summary",{children:[s," ",r("small",{class:"note",children:t.description})]}),r(ot,{...e}),ms(t)&&r("button",{type:"button",class:"link",onClick:()=>i(void 0),children:l("Remove {name}",{name:s})})]})}function ei(e){let{schema:t,name:n,value:s,onChange:i}=e,o=at(t);return o==="array"?t.items?.type==="object"?r(Yr,{...e}):r(it,{name:n,help:t.description,children:r(Xr,{...e})}):o==="object"?t.properties?r(Qr,{...e}):r(Zr,{...e}):t.enum||o==="boolean"?r(it,{name:n,help:t.description,children:r(Ur,{...e})}):o==="number"||o==="integer"?r(it,{name:n,help:t.description,children:r(ps,{...e})}):r(it,{name:n,help:t.description,children:r("input",{type:"text",maxLength:t.maxLength??200,value:U(s),placeholder:U(e.usual),onChange:a=>i(a.currentTarget.value===""?void 0:a.currentTarget.value)})})}var gs=/^[=+\-@\t\n\uFF1D\uFF0B\uFF0D\uFF20]/,fs=1e5;function G(e){let t=e.replace(/[\u0000-\u0008\u000B-\u001F\u007F]/g,"");return`"${(gs.test(t)?`'${t}`:t).replaceAll('"','""')}"`}function qt(e,t,n){let s=e.replace(/^\uFEFF/,""),i=s.split(`
`,1)[0]??"",o=i.split(";").length>i.split(",").length?";":",",a=[],u=[],c=[""],d=!1,m=1,p=1,g=()=>{if(c.some(h=>h.trim()!=="")&&(u.length===0?u=c.map(h=>h.trim().toLowerCase()):a.push({fields:c,line:p})),a.length>fs)throw new Error(l("{file}, line {line}: the table has more than {most} rows",{file:t,line:m,most:fs}));c=[""],p=m};for(let h=0;h<s.length;++h){let w=s[h],R=c.length-1,q=c[R]??"";w===`
`&&++m,d&&w==='"'&&s[h+1]==='"'?(c[R]=q+w,++h):w==='"'&&(d||q.trim()==="")?d=!d:!d&&w===o?c.push(""):!d&&w===`
`?g():c[R]=q+w}g();let f=n.filter(h=>!u.includes(h));if(f.length>0)throw new Error(l('{file}, line 1: there is no column "{missing}"; expected the columns {needed}',{file:t,missing:f.join('", "'),needed:n.join(", ")}));return{columns:u,count:a.length,lineOf:h=>a[h]?.line??0,at(h,w){let R=(a[h]?.fields[u.indexOf(w)]??"").trim();return R.startsWith("'")&&gs.test(R.slice(1))?R.slice(1):R}}}var bs=6,V=e=>e.toFixed(2),hs=({grade:e})=>e!==void 0&&!e.refused;function ti(e,t){if(t.length===0)return e;if(t.length===1)return l("{text} (line {line})",{text:e,line:t[0]});let n=t.slice(0,bs).join(", "),s=t.length-bs;return s>0?l("{text} (lines {lines} and {more} more)",{text:e,lines:n,more:s}):l("{text} (lines {lines})",{text:e,lines:n})}function ni(e,t){let n=new Map;for(let{severity:s,message:i,line:o}of e){if(s!=="error"&&!t)continue;let a=n.get(i)??[];n.set(i,o?[...a,o]:a)}return[...n].map(([s,i])=>ti(s,i))}function _t({comments:e,tasks:t}){let n=[...e];for(let{task:s,grade:i,failure:o}of t){let a=u=>void n.push((s?`${s}: `:"")+u);if(o&&a(o.message),!!i){for(let{criterion:u,comment:c}of i.overrides??[])c&&a((u?`${u}: `:"")+c);i.reason&&i.diagnostics.length===0&&a(l("not graded: {reason}",{reason:i.reason.message}));for(let{message:u,points:c,code:d}of i.findings)c>0?a(`${u} (-${V(c)})`):d.endsWith(".missing")&&a(u);i.unexplained.points>0&&a(l("unexplained: the pictures differ for a reason that was not found (-{points})",{points:V(i.unexplained.points)}));for(let u of ni(i.diagnostics,i.penalty>0))a(u);for(let u of i.criteria)u.measured!==void 0&&u.points<u.most&&!i.refused&&a(u.reason)}}return n.join(`
`)}var vs=({name:e,identifier:t})=>`${G(t&&!/^participant /i.test(t)?`Participant ${t}`:t)},${G(e)}`;function ys({marks:e,groups:t}){return["Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,Feedback comments",...e.flatMap(s=>{let i=G(_t(s));return Pe(t,s.submission).map(o=>[vs(o),s.graded?V(s.points):"",V(s.most),"",s.graded?s.passed?"yes":"no":"",G(s.submission.id),i].join(","))}),""].join(`\r
`)}function ks({marks:e,groups:t,tasks:n}){let s=n.map((a,u)=>{let c=new Set;for(let d of e)for(let m of(d.tasks[u]?.grade?.criteria??[]).map(p=>p.measure).sort())c.add(m);return[...c]}),i=["Identifier,Full name,Submission,Grade,By hand",...n.flatMap((a,u)=>[...a?[G(a)]:[],...(s[u]??[]).map(c=>G((a?`${a}: `:"")+c))])].join(","),o=e.flatMap(a=>{let u=n.flatMap((d,m)=>{let p=a.tasks[m],g=hs(p);return[...d?[g?V(p.grade?.points??0):""]:[],...(s[m]??[]).map(f=>{let h=p.grade?.criteria.filter(w=>w.measure===f).at(-1);return g&&h?V(h.points):""})]}),c=a.overridden||a.tasks.some(({grade:d})=>d?.overrides);return Pe(t,a.submission).map(d=>[vs(d),G(a.submission.id),a.graded?V(a.points):"",c?"yes":"",...u].join(","))});return[i,...o,""].join(`\r
`)}var ws=e=>["student,task,criterion,mark,comment",...e.map(({student:t,task:n,criterion:s,mark:i,comment:o})=>[G(t),G(n),G(s),i??"",G(o)].join(",")),""].join(`\r
`);function xs(e,t){let n=qt(e,t,["student","mark","comment"]);return Array.from({length:n.count},(s,i)=>{let o=n.at(i,"mark"),a=o===""?null:Number(o.replace(",","."));if(a!==null&&!(a>=0&&a<=1e6))throw new Error(l('{file}, line {line}: the mark is "{value}"; expected a number of 0 or more',{file:t,line:n.lineOf(i),value:o}));return{student:n.at(i,"student"),task:n.at(i,"task"),criterion:n.at(i,"criterion").toLowerCase(),mark:a,comment:n.at(i,"comment")}})}function Ss(e,t){let n=qt(e,t,["submission","full name","identifier"]);return Array.from({length:n.count},(s,i)=>({submission:n.at(i,"submission"),name:n.at(i,"full name"),identifier:n.at(i,"identifier").replace(/^participant /i,"")}))}var ce=e=>e.replace(/[\u0000-\u0008\u000B-\u001F\uFFFE\uFFFF]/g,"").replaceAll("&","&amp;").replaceAll("<","&lt;").replaceAll(">","&gt;").replaceAll('"',"&quot;").replaceAll(`
`,"&#10;").replaceAll("	","&#9;");function Cs(e){let t=e.marks.flatMap(o=>o.tasks.map(a=>({mark:o,task:a}))),n=({grade:o})=>o!==void 0&&!o.refused&&!o.passed,s=`tests="${t.length}" failures="${t.filter(({task:o})=>n(o)).length}" errors="${t.filter(({task:o})=>!hs(o)).length}"`,i=t.map(({mark:o,task:a})=>{let{grade:u,failure:c}=a,d=c?`<error type="${ce(c.code)}" message="${ce(c.message)}"/>`:u?.refused?`<error type="grade.refused" message="${ce(_t(o))}"/>`:n(a)?`<failure message="${V(u?.points??0)} of ${V(u?.most??0)} points">${ce(_t(o))}</failure>`:"";return`<testcase classname="${ce(o.submission.id)}" name="${ce(a.task||"grade")}">${d}<system-out>${V(u?.points??0)} points</system-out></testcase>
`});return`<?xml version="1.0" encoding="UTF-8"?>
<testsuites ${s}>
<testsuite name="${ce(e.title)}" ${s}>
${i.join("")}</testsuite>
</testsuites>
`}var Me=(e,t)=>n=>e.test(n)?n.replace(e,t):null,si={none:(e=>e),sign:Me(/(<rotate\b[^>]*\bangle=")(-?)([0-9.]*[1-9][0-9.]*")/i,(e,t,n,s)=>`${t}${n?"":"-"}${s}`),order:Me(/(<translate\b[^>]*\/>)(\s*)(<rotate\b[^>]*\/>)/i,(e,t,n,s)=>`${s}${n}${t}`),light:Me(/<light\b[^>]*\/>/i,()=>""),color:Me(/<diffuse\b[^>]*\/>/i,()=>'<diffuse R="30" G="60" B="220"/>'),camera:Me(/(<position\b[^>]*\bx=")(-?[0-9.]+)(")/i,(e,t,n,s)=>`${t}${(Number(n)+2).toFixed(2)}${s}`),radians:Me(/(<rotate\b[^>]*\bangle=")(-?[0-9.]*[1-9][0-9.]*)(")/i,(e,t,n,s)=>`${t}${(Number(n)*Math.PI/180).toFixed(4)}${s}`),broken:(e=>`This is my homework: ${e.length} letters of XML, see my other e-mail`)},ri=[["Ana Reis",["none"]],["Bento Dias",["sign","light"]],["Carla Lopes",["order","color"]],["Duarte Melo",["light","color"]],["Eva Pinto",["radians","camera"]],["Filipe Sá",["camera"]],["Gil Vaz",["broken"]]],ii=["robot-arm","torch"],ai=40;async function Ms(e){let[{main:t,files:n},s]=await Promise.all([en(e),tn(e)]),i=await Promise.all(n.filter(({path:o})=>o!==t).slice(0,ai).map(async({path:o})=>({path:o,file:await(await Te(`${Zt(e)}/file?${new URLSearchParams({path:o})}`)).blob()})));return{id:e,xml:s,files:i}}async function oi(){let t=(await Promise.all(ii.map(i=>Ms(i).catch(()=>null)))).filter(i=>i!==null);if(t.length>0)return t;let s=(await(await Te("v1/scenes?page=1")).json()).scenes.find(({valid:i})=>i);return s?[await Ms(s.id)]:[]}var Rs=e=>new Blob([e],{type:"application/xml"});async function Ts(){let e=await oi();if(e.length===0)return null;let t=e.map(({id:s,xml:i,files:o})=>({name:s,rubric:null,reference:{name:s,fileName:`${s}.tar`,file:yt([{path:`${s}.xml`,file:Rs(i)},...o])}})),n=ri.map(([s,i],o)=>{let a=e.flatMap(({id:d,xml:m},p)=>{let g=si[i[p]??i[0]??"none"](m)??m;return[{path:`${d}.xml`,file:Rs(g)}]}),u=`${s}_${1001+o}_assignsubmission_file_`,c=yt(a);return{id:u,...gn(u),fileName:`${u}.tar`,bytes:c.size,file:c}});return{tasks:t,submissions:n}}var X=y([]),te=y(""),li=8*1024*1024,ui=({path:e},t)=>e.split("/").length<=Math.min(...t.map(n=>n.path.split("/").length));async function Kt({file:e,path:t}){if(e.size>li)throw new Error(l("{name} is larger than 8 MiB",{name:t}));return e.text()}async function ci(e){let t=await Kt(e),n=e.path.replace(/^.*\//,""),s=J.value&&Je(t,J.value);if(s&&s.problems.length>0){let{line:a,pointer:u,message:c}=s.problems[0];throw new Error(l("{name}, line {line}: {pointer} {message}",{name:n,line:a,pointer:u,message:c}))}let i={name:n,text:t};if(b.value.length===0)return Ze([{name:kt(n),reference:null,rubric:i}],!1);let o=b.value.findIndex(a=>a.name.toLowerCase()===kt(n).toLowerCase());for(let a of o>=0?[o]:b.value.keys())Ge(a,i)}async function di(e){let t=[],n=[];for(let s of e){let i=s.path.replace(/^.*\//,"").toLowerCase();i==="overrides.csv"?N.value=xs(await Kt(s),s.path):i==="groups.csv"?H.value=Ss(await Kt(s),s.path):i.endsWith(".json")&&ui(s,e)?n.push(s):t.push(s)}n.sort((s,i)=>Number(/rubric\.json$/i.test(i.path))-Number(/rubric\.json$/i.test(s.path)));for(let s of n)await ci(s);return t}async function $s(e,t){X.value=[],te.value=l("Reading the files…");try{let n=e.filter(({path:o})=>!rn(o)),s=await di(n),i=s.length>0||n.length===0?await t(s):null;i&&(X.value=[i])}catch(n){X.value=[n.message]}te.value=""}var Jt=(e,t=!1)=>$s(e,async n=>{let s=hn(n);return s.length===0?l("There is no scene or image among these files."):(await Ze(s,t),null)}),lt=e=>$s(e,async t=>{let n=await bn(t,b.value.map(({name:s})=>s));return n.length===0?l("There is no scene, archive or image among these files."):(await Lt(n),null)});async function Ps(){X.value=[],te.value=l("Making the example…");try{let e=await Ts();e?(await Ze(e.tasks,!1),await Lt(e.submissions),fe(l("{count} submissions made.",{count:C.value.length}))):X.value=[l("This service has no scenes to make an example of.")]}catch(e){X.value=[e.message]}te.value=""}var Wt=y("form");function Os(e,t){let n=b.value[e],s=J.value;if(!n||!s)return;let i=Je(t,s),{[n.name]:o,...a}=ue.value;ue.value=i.problems.length>0?{...a,[n.name]:{text:t,check:i}}:a,i.problems.length===0&&Ge(e,{name:n.rubric?.name??"rubric.json",text:t})}function mi(){let e=xe.value,t=$.value.filter(({graded:a})=>a);if(!e||e.size===0)return null;let n=t.filter(({submission:a})=>e.has(a.id)),s=a=>a.reduce((u,c)=>u+c,0)/a.length,i=n.filter(a=>Math.abs(a.points-(e.get(a.submission.id)??0))>=.005).length;if(n.length===0)return null;let o=a=>A(a,{maximumFractionDigits:2});return r("p",{class:"effect",role:"status",children:[i===0?l("No mark changes."):`${L(i,"{count} mark changes","{count} marks change")}: ${l("mean {now}, before {before}",{now:o(s(n.map(({points:a})=>a))),before:o(s(n.map(({submission:a})=>e.get(a.id)??0)))})}. `,we.value>0&&r("span",{class:"bad",children:[L(we.value,"{count} must be rendered again.","{count} must be rendered again.")," "]}),i>0&&r("button",{type:"button",class:"link",onClick:Ie,children:l("Compare with these from now on")})]})}function pi({one:e,share:t,summary:n,set:s,remove:i}){let o=(a,u)=>e[a]===void 0?null:r("label",{class:"field",children:[r("span",{children:a}),r("input",{type:"number",min:"0",max:u,step:"any",value:e[a],"aria-label":`${e.measure} ${a}`,onInput:c=>{let d=Number(c.currentTarget.value);c.currentTarget.value!==""&&Number.isFinite(d)&&s({[a]:d})}})]});return r("li",{children:[r("div",{class:"criterion",children:[r("b",{children:e.measure}),r("span",{class:"figure note",children:[A(100*t,{maximumFractionDigits:1})," %"]})]}),r("p",{class:"note",children:n}),r("div",{class:"numbers",children:[o("weight",1e3),o("tolerance",1),o("limit",1),o("perFinding",1),i&&r("button",{type:"button",class:"link",onClick:i,children:l("Remove {name}",{name:e.measure})})]})]})}function fi({document:e,rubric:t,all:n,set:s}){let i=t.criteria.reduce((c,d)=>c+d.weight,0),o=n.gradeMeasures.filter(({name:c})=>!t.criteria.some(({measure:d})=>d===c)),a=c=>s({...e,criteria:c}),u=(c,d)=>a(t.criteria.map((m,p)=>p===c?{...m,...d}:m));return r("details",{class:"entry",open:!0,children:[r("summary",{children:[r("code",{children:"criteria"})," ",r("small",{class:"note",children:l("the comparison with the reference; weights are shares of {points} points",{points:E(t)})})]}),r("ul",{class:"criteria",children:t.criteria.map((c,d)=>r(pi,{one:c,share:i>0?c.weight/i:0,summary:n.gradeMeasures.find(({name:m})=>m===c.measure)?.summary??"",set:m=>u(d,m),remove:t.criteria.length>1?()=>a(t.criteria.filter((m,p)=>p!==d)):null},c.measure))}),o.length>0&&r("label",{class:"field",children:[r("span",{children:l("Add a measure")}),r("select",{value:"",onChange:c=>{let d=c.currentTarget.value,m=n.gradeMeasures.find(({name:p})=>p===d);m&&a([...t.criteria,{measure:d,weight:m.weight}])},children:[r("option",{value:""}),o.map(({name:c})=>r("option",{value:c,children:c},c))]})]})]})}function gi(e){let{document:t,rubric:n,all:s,set:i}=e,o=c=>i(c),a=c=>r(ot,{name:"",path:"",schema:s.rubric,value:t,usual:n,onChange:o,only:c}),u=["title","points","passMark","strictness",...b.value.length>1?["weight"]:[]];return r(S,{children:[a(u),r(fi,{...e}),r("details",{class:"entry",open:n.requirements.length+n.manual.length>0,children:[r("summary",{children:l("Requirements and parts marked by hand")}),a(["requirements","manual","define"])]}),r("details",{class:"entry",children:[r("summary",{children:l("Penalties")}),a(["penalties"])]}),r("details",{class:"entry",children:[r("summary",{children:[l("Cameras, times and images")," ",r("small",{class:"note",children:l("a change is rendered again")})]}),a(["views","times","picture","lend","images","reveal"])]})]})}function bi({text:e,check:t,at:n}){let s=z(null),i=o=>{let a=s.current;if(!a)return;let u=e.split(`
`).slice(0,o-1).join(`
`).length+(o>1?1:0),c=e.indexOf(`
`,u);a.focus(),a.setSelectionRange(u,c<0?e.length:c),a.scrollTop=Math.max(0,(o-4)*Number.parseFloat(getComputedStyle(a).lineHeight))};return r(S,{children:[r("textarea",{ref:s,class:"json",spellcheck:!1,"aria-label":l("Rubric as JSON"),"aria-invalid":!!t,value:e,rows:24,onInput:o=>Os(n,o.currentTarget.value)}),t&&r(Fs,{check:t,goTo:i})]})}function Fs({check:e,goTo:t}){return r("div",{class:"problem",role:"status",children:[r("p",{children:l("Not applied:")}),r("ul",{children:e.problems.map(({pointer:n,message:s,line:i},o)=>r("li",{children:[t?r("button",{type:"button",class:"link",onClick:()=>t(i),children:l("line {line}",{line:i})}):null," ",r("code",{children:n})," ",s]},o))})]})}function Ns(){let e=Math.min(Se.value,b.value.length-1),t=b.value[e],n=T.value[e],s=J.value;if(!t||!n||!s)return r("p",{class:"note",children:l("Choose a reference first.")});let i=ue.value[t.name],o=i?.text??t.rubric?.text??Rt(s.defaultRubric),a=i?i.check.document:JSON.parse(t.rubric?.text??"{}"),u=d=>Os(e,Rt(d)),c=()=>{let{[t.name]:d,...m}=ue.value;ue.value=m,Ge(e,null)};return r("section",{id:"rubric","aria-label":l("Rubric"),children:[b.value.length>1&&r("div",{class:"choices",role:"group","aria-label":l("Task"),children:b.value.map(({name:d},m)=>r("button",{type:"button","aria-pressed":m===e,onClick:()=>Se.value=m,children:d},d))}),r("div",{class:"choices",children:[["form","json"].map(d=>r("button",{type:"button","aria-pressed":Wt.value===d,onClick:()=>Wt.value=d,children:d==="form"?l("Form"):"JSON"},d)),r("span",{class:"space"}),r("button",{type:"button",onClick:()=>void $e(!1).then(lt),children:[r(K,{name:"upload"}),l("Open a rubric")]}),r("button",{type:"button",onClick:()=>_e(new Blob([o],{type:"application/json"}),t.rubric?.name??"rubric.json"),children:[r(K,{name:"download"}),l("Save the rubric")]}),(t.rubric||i)&&r("button",{type:"button",onClick:c,children:l("Back to the default")})]}),r(mi,{}),Wt.value==="json"?r(bi,{text:o,check:i?.check??null,at:e}):a===null?r("p",{class:"problem",children:l("This is no JSON: correct it there.")}):r(S,{children:[i&&r(Fs,{check:i.check}),r(gi,{document:a,rubric:i&&i.check.document?{...n}:n,all:s,set:u})]})]})}var Ls=`:root {
  --back: #fbfbf9; --card: #ffffff; --ink: #1c2024; --dim: #5b646d; --line: #d9dde1;
  --accent: #0b62a8; --good: #1a7f3c; --bad: #b3261e; --mark: #fff3c9;
}
@media (prefers-color-scheme: dark) {
  :root {
    --back: #14171a; --card: #1d2125; --ink: #e8eaec; --dim: #a2abb3; --line: #363c42;
    --accent: #6db6f2; --good: #6fd08c; --bad: #ff8a80; --mark: #4a3f16;
  }
}
* { box-sizing: border-box; }
body { margin: 0; display: flex; flex-direction: column; height: 100vh; font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--back); }
header { padding: 16px 24px; border-bottom: 1px solid var(--line); }
h1 { font-size: 1.3rem; margin: 0; }
.grades { flex: 1; min-height: 0; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
@media (max-width: 900px) { body { height: auto; } }
@media print { body { height: auto; } }
@media (max-width: 560px) { header { padding: 12px; } }
`;var Bs=`<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>Grades</title>
<style>/*STYLE*/</style>
</head>
<body>
<header class="grades-head"><h1 id="title">Grades</h1></header>
<main class="grades"></main>
<!--DATA-->
<script type="module">/*SCRIPT*/<\/script>
</body>
</html>
`;var js=`const read = (element) => JSON.parse(element.textContent);
const about = read(document.getElementById('class'));
const pictures = (id) => {
  const element = document.getElementById(id);
  return element ? read(element) : [];
};
const submissions = [...document.querySelectorAll('script.submission')].map((element, index) => {
  const one = read(element);
  one.tasks.forEach((task, number) => {
    task.references = () => pictures(\`r\${number}\`);
    task.pictures = () => pictures(\`p\${index}-\${number}\`);
  });
  return one;
});
const hashOf = (one) => '#' + encodeURIComponent(one.id);

document.getElementById('title').textContent = about.title;
document.documentElement.lang = about.language;
const view = gradesView({
  head: document.querySelector('header'), body: document.querySelector('main'), keys: document,
  chosen: (one) => history.replaceState(null, '', hashOf(one)), translation: about.words,
});
document.title = say('title', {title: about.title});
view.show(submissions);
const linked = submissions.findIndex((one) => hashOf(one) === location.hash);
if (linked >= 0) view.choose(linked, false);
`;var Gs=`/* Grades as view.js shows them. Whoever shows them names the colours: --back, --card, --ink, --dim, --line,
   --accent, --good, --bad, --mark. */
.grades-head { display: flex; flex-wrap: wrap; gap: 4px 24px; align-items: baseline; }
.grades-head #summary { margin: 0; color: var(--dim); flex: 1; }
.grades-head input { font: inherit; color: inherit; background: var(--card); border: 1px solid var(--line); border-radius: 6px; padding: 5px 10px; min-width: 260px; }
.grades { display: grid; grid-template-columns: minmax(360px, 5fr) 7fr; }
.grades > section { overflow: auto; padding: 16px 24px; min-width: 0; }
.grades #detail { border-left: 1px solid var(--line); outline: none; }
.grades p { margin: 1em 0; overflow-wrap: anywhere; }
.grades table { border-collapse: collapse; width: 100%; }
.grades th { text-align: left; position: sticky; top: -16px; background: var(--back); }
.grades th button { white-space: nowrap; font: inherit; font-weight: 600; color: inherit; background: none; border: 0; padding: 6px 8px; cursor: pointer; }
.grades th[aria-sort="ascending"] button::after { content: " \\25B2"; }
.grades th[aria-sort="descending"] button::after { content: " \\25BC"; }
.grades td { padding: 6px 8px; border-top: 1px solid var(--line); vertical-align: top; }
.grades #list td:nth-child(2) { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.grades #list td:nth-child(3) { white-space: nowrap; }
.grades #list td:nth-child(4), .grades #list td:first-child { overflow-wrap: anywhere; }
.grades #list tbody tr { cursor: pointer; }
.grades #list tbody tr:hover { background: var(--card); }
.grades #list tbody tr[aria-selected="true"] { background: var(--mark); }
.grades .good { color: var(--good); } .grades .bad { color: var(--bad); } .grades .dim, .grades .hint { color: var(--dim); }
.grades h2 { font-size: 1.15rem; margin: 0 0 4px; overflow-wrap: anywhere; } .grades h3 { font-size: 1rem; margin: 20px 0 6px; }
.grades .bar { height: 6px; background: var(--line); border-radius: 3px; overflow: hidden; min-width: 90px; }
.grades .bar i { display: block; height: 100%; background: var(--accent); }
.grades ul.findings { display: block; list-style: none; margin: 0; padding: 0; }
.grades ul.findings li { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 8px 12px; margin-bottom: 8px; color: inherit; font-size: inherit; overflow-wrap: anywhere; }
.grades pre { margin: 6px 0 0; padding: 8px; background: var(--back); border-radius: 6px; overflow: auto; font-size: 13px; }
.grades pre b { background: var(--mark); font-weight: inherit; display: block; }
.grades .tabs { display: flex; flex-wrap: wrap; gap: 6px; margin-bottom: 8px; padding: 0; border: 0; }
.grades .tabs button { font: inherit; color: inherit; background: var(--card); border: 1px solid var(--line); border-radius: 6px; padding: 3px 10px; margin: 0; cursor: pointer; }
.grades .tabs button[aria-pressed="true"] { border-color: var(--accent); color: var(--accent); }
.grades .compare { cursor: ew-resize; touch-action: pan-y; user-select: none; position: relative; max-width: 560px; background: #000; border-radius: 8px; overflow: hidden; line-height: 0; }
.grades .compare img { width: 100%; display: block; }
.grades .compare .over { position: absolute; inset: 0; }
.grades .compare span { position: absolute; bottom: 6px; line-height: 1.4; font-size: 12px; color: #fff; background: rgba(0,0,0,.6); padding: 1px 8px; border-radius: 4px; }
.grades .compare span.left { left: 6px; } .grades .compare span.right { right: 6px; }
.grades .compare hr { position: absolute; top: 0; bottom: 0; width: 2px; margin: 0; border: 0; background: #fff; pointer-events: none; }
.grades .controls { max-width: 560px; display: flex; gap: 12px; align-items: center; margin-top: 6px; }
.grades .controls input[type="range"] { flex: 1; min-width: 0; accent-color: var(--accent); }
.grades .side { display: grid; grid-template-columns: repeat(auto-fit, minmax(180px, 1fr)); gap: 8px; margin-top: 8px; max-width: 900px; }
.grades .side figure { margin: 0; } .grades .side img { width: 100%; background: #000; border-radius: 6px; display: block; } .grades figcaption { color: var(--dim); font-size: 13px; }
.grades .points td:nth-child(3) { white-space: nowrap; font-variant-numeric: tabular-nums; }
@media (max-width: 900px) { .grades { display: block; } .grades #detail { border-left: 0; border-top: 1px solid var(--line); } }
@media print { .grades { display: block; } }
@media (max-width: 560px) {
  .grades > section { padding: 12px; }
  .grades-head input { min-width: 0; width: 100%; }
  .grades-head label { flex: 1; }
  .grades #list th button, .grades #list td { padding: 5px 4px; }
  .grades .points td:nth-child(2) { display: none; }
  /* The first finding stands under the rest of its row. */
  .grades #list tr { display: grid; grid-template-columns: minmax(0, 1fr) auto 5.5rem; }
  .grades #list tr > :nth-child(4) { grid-column: 1 / -1; border-top: 0; padding-top: 0; }
  .grades #list th { position: static; }
}
`;var Is=`// The grades of a class: a table that is sorted and filtered, and what is known of the submission chosen from
// it. Both the report of \`farol grade\` and the web page show it.

/** Its words, by the ids of the message catalogue without "part.page/" (grade/report/messages.h). */
const english = {
  'all-equal': 'The pictures are equal',
  'and-more': '{list} and {count} more',
  'as-reference': 'as the reference',
  'causes': 'Causes',
  'choose': 'Choose a submission: click it, or use the arrow keys; / goes to the filter',
  'costs-nothing': 'costs nothing',
  'coverage': 'objects elsewhere {share} %',
  'depth': 'other depth {share} %',
  'details': 'Details',
  'diagnostics': 'Diagnostics',
  'diagnostics-cost': 'Diagnostics cost {points} points',
  'difference': 'difference',
  'difference-caption': 'difference: black none, white most',
  'differs': 'Differs: {share} %',
  'earns-nothing': 'earns nothing',
  'equal': 'equal',
  'error': 'error',
  'failed': 'failed',
  'filter': 'Filter',
  'filter-hint': 'name, finding, passed, failed',
  'finding': 'First finding',
  'flip': 'FLIP mean {mean}, 95th percentile {percentile}',
  'info': 'info',
  'line': 'line {line}',
  'lines': 'lines {lines}',
  'median': 'median {median} of {most} points',
  'no-match': 'No submission matches',
  'no-submissions': 'no submissions',
  'normals': 'other normals {share} %',
  'not-graded': 'not graded',
  'not-graded-reason': 'Not graded: {reason}',
  'not-seen': 'costs nothing: it cannot be seen',
  'nothing-differs': 'Nothing was found that differs',
  'one-submission': '1 submission',
  'passed': 'passed',
  'passed-count': '{count} passed',
  'pictures': 'Pictures',
  'points': 'Points',
  'points-of': '{points} of {most} points',
  'reference': 'reference',
  'result': 'Result',
  'share-shown': 'Share of the submission that is shown',
  'similarity': 'The image shows {share} % of the reference',
  'submission': 'submission',
  'submission-head': 'Submission',
  'submissions': 'Submissions',
  'submissions-count': '{count} submissions',
  'title': 'Grades: {title}',
  'unexplained': 'Unexplained: the pictures still differ when all of this is corrected (−{points})',
  'unread-count': '{count} could not be graded',
  'warning': 'warning',
};
let words = english;
/** A word of the page in its language, with the values of its placeholders. */
const say = (id, values = {}) => words[id].replace(/\\{([a-z]+)\\}/g, (all, name) => values[name]);

/** Why most points were lost, where no finding says it. */
function mostLost(one) {
  const lost = one.tasks.flatMap((task) => task.grade ? task.grade.criteria : []).filter((entry) => entry.points < entry.most);
  lost.sort((a, b) => (b.most - b.points) - (a.most - a.points));
  return lost.length ? lost[0].reason : '';
}
/** Why a task has no mark; grades of earlier versions have their first error alone. */
function reasonOf(grade) {
  if (grade.reason) return grade.reason.message;
  return grade.diagnostics.filter((d) => d.severity === 'error').map((d) => d.message)[0] || '';
}
/** The submission with what the table shows of it and what the filter looks into. */
function rowOf(one, index) {
  const findings = one.tasks.flatMap((task) => task.grade ? task.grade.findings : []);
  const costly = findings.filter((finding) => finding.points > 0);
  const failure = one.tasks.find((task) => task.failure);
  const refused = one.tasks.find((task) => task.grade && task.grade.refused);
  const first = failure ? failure.failure.message
    : refused ? reasonOf(refused.grade)
    : costly.length ? costly[0].message : mostLost(one);
  const unread = one.tasks.length > 0 && one.tasks.every((task) => task.failure || task.grade && task.grade.refused);
  // A submission that could not be graded is not wrong: it wants a look, or a letter.
  const result = one.state || say(one.passed ? 'passed' : unread ? 'not-graded' : 'failed');
  const text = [one.id, one.name, one.identifier || '', result, first]
    .concat(findings.map((finding) => finding.message + ' ' + finding.code)).join(' ').toLowerCase();
  return {...one, index, first, unread, result, text};
}

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== undefined && child !== ''));
  return element;
}
const number = (value) => (Math.round(value * 100) / 100).toString();

/** Both pictures in one frame, the submission over the reference as far as the slider says. */
function slider(given, expected) {
  const over = make('img', {class: 'over', src: given, alt: say('submission')});
  const line = make('hr');
  const frame = make('div', {class: 'compare'}, make('img', {src: expected, alt: say('reference')}), over, line,
    make('span', {class: 'left'}, say('submission')), make('span', {class: 'right'}, say('reference')));
  const share = make('input', {type: 'range', min: 0, max: 100, value: 50, 'aria-label': say('share-shown')});
  const slide = () => {
    over.style.clipPath = \`inset(0 \${100 - share.value}% 0 0)\`;
    line.style.left = share.value + '%';
  };
  share.addEventListener('input', slide);
  const follow = (event) => {
    if (!(event.buttons & 1)) return;
    const {left, width} = frame.getBoundingClientRect();
    share.value = Math.round(100 * (event.clientX - left) / width);
    slide();
  };
  frame.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    frame.setPointerCapture(event.pointerId);
    follow(event);
  });
  frame.addEventListener('pointermove', follow);
  slide();
  return [frame, make('div', {class: 'controls'}, share)];
}

function comparison(task) {
  const theirs = task.references(), mine = task.pictures(), views = task.grade.views;
  if (!views.length) return '';
  const shares = (view) => view.difference === undefined ? '' : [
    say('differs', {share: number(100 * view.difference)}),
    view.flip && say('flip', {mean: view.flip.mean.toFixed(3), percentile: view.flip.p95.toFixed(3)}),
    view.ssim !== undefined && \`SSIM \${view.ssim.toFixed(3)}\`,
    view.coverage !== undefined && say('coverage', {share: number(100 * view.coverage)}),
    view.depth !== undefined && say('depth', {share: number(100 * view.depth)}),
    view.normals !== undefined && say('normals', {share: number(100 * view.normals)}),
  ].filter(Boolean).join(' · ');
  const box = make('div'), tabs = make('div', {class: 'tabs'}), stage = make('div');
  const show = (index) => {
    [...tabs.children].forEach((tab, i) => tab.setAttribute('aria-pressed', String(i === index)));
    const view = views[index], expected = theirs[index] || theirs[0];
    const given = mine[2 * index] || expected, heat = mine[2 * index + 1];
    const figure = (src, alt, caption) => src ? make('figure', {}, make('img', {src, alt}), make('figcaption', {}, caption)) : '';
    stage.replaceChildren(...(expected ? slider(given, expected) : []),
      make('p', {class: 'dim'}, expected && given === expected && !heat ? say('all-equal') + '.' : shares(view)),
      make('div', {class: 'side'}, figure(expected, say('reference'), say('reference')), figure(given, say('submission'), say('submission')),
        figure(heat, say('difference'), say('difference-caption'))));
  };
  views.forEach((view, index) => tabs.append(make('button', {type: 'button', onclick: () => show(index)}, view.name,
    view.difference === undefined ? '' : make('span', {class: 'dim'}, view.difference ? \` \${number(100 * view.difference)} %\` : ' ' + say('equal')))));
  box.append(make('h3', {}, say('pictures')), tabs, stage);
  // What differs most is seen first.
  show(views.reduce((most, view, index) => view.difference > views[most].difference ? index : most, 0));
  return box;
}

function excerpt(text) {
  const block = make('pre');
  block.tabIndex = 0;  // long lines scroll, by the keyboard too
  for (const line of text.split('\\n')) {
    if (!line) continue;
    block.append(/^\\d+ > /.test(line) ? make('b', {}, line) : line + '\\n');
  }
  return block;
}

/** What a cause costs; what is missing earns nothing, and what nobody sees costs nothing. */
function costText(finding) {
  if (finding.points > 0) return \`−\${number(finding.points)}\`;
  return say(finding.seen === false ? 'not-seen' : finding.code.endsWith('.missing') ? 'earns-nothing' : 'costs-nothing');
}

/** The lines at every place of a cause, three at most. */
function excerptsOf(finding) {
  const texts = [finding.excerpt, ...(finding.places || []).map((place) => place.excerpt)].filter(Boolean);
  return texts.slice(0, 3).map(excerpt);
}

/** Diagnostics of one message as one, with all their lines. */
function merged(diagnostics) {
  const found = new Map();
  for (const entry of diagnostics) {
    const key = entry.severity + entry.message, known = found.get(key);
    if (!known) found.set(key, {...entry, lines: entry.line ? [entry.line] : []});
    else if (entry.line) known.lines.push(entry.line);
  }
  return [...found.values()];
}

function place({file, lines}) {
  if (!lines.length) return '';
  const first = lines.slice(0, 12).join(', ');
  const listed = lines.length > 12 ? say('and-more', {list: first, count: lines.length - 12}) : first;
  const text = lines.length > 1 ? say('lines', {lines: listed}) : say('line', {line: listed});
  return make('span', {class: 'dim'}, \` \${file ? file + ', ' : ''}\${text}\`);
}

/** Styles are set by the script: the web page's policy allows no attributes of them. */
function bar(percent) {
  const filled = make('i');
  filled.style.width = \`\${percent}%\`;
  return filled;
}

/** A requirement or a part that a person marks: its text, how far it is met, and the lines that show it. */
function requirement(entry) {
  const lines = (entry.matches || []).map((thing) => thing.line).filter(Boolean);
  return make('td', {}, entry.text, ' ',
    make('strong', {class: entry.state === 'met' || entry.state === 'marked' ? 'good' : entry.state === 'open' ? 'dim' : 'bad'}, entry.state),
    make('span', {class: 'dim'}, \` \${entry.reason || ''}\`), place({lines}));
}

/** All that is known of a submission, as elements. */
function detailOf(one) {
  if (!one.tasks.length) return [make('h2', {}, one.name || one.id), make('p', {class: 'dim'}, one.result)];
  const parts = [make('h2', {}, one.name || one.id),
    make('p', {}, make('strong', {class: one.passed ? 'good' : 'bad'}, one.unread ? say('not-graded') : say('points-of', {points: number(one.points), most: number(one.most)})), make('span', {class: 'dim'}, ' · ' + [one.identifier, one.id].filter(Boolean).join(' · ')))];
  one.tasks.forEach((task) => {
    if (task.task) parts.push(make('h3', {}, task.task));
    if (task.failure) {
      parts.push(make('p', {class: 'bad'}, task.failure.message + (task.failure.code ? \` [\${task.failure.code}]\` : '')));
      return;
    }
    const grade = task.grade;
    if (grade.findings.length) {
      parts.push(make('h3', {}, say('causes')), make('ul', {class: 'findings'}, ...grade.findings.map((finding) =>
        make('li', {}, finding.message, ' ',
          make('span', {class: finding.points > 0 ? 'bad' : 'dim'}, costText(finding)), ...excerptsOf(finding)))));
    }
    if (grade.unexplained && grade.unexplained.points > 0)
      parts.push(make('p', {class: 'bad'}, say('unexplained', {points: number(grade.unexplained.points)}) + '.'));
    if (grade.diagnostics.length)
      parts.push(make('h3', {}, say('diagnostics')), make('ul', {class: 'findings'}, ...merged(grade.diagnostics).map((entry) =>
        make('li', {}, make('span', {class: entry.severity === 'error' ? 'bad' : 'dim'}, say(entry.severity) + ': '), entry.message, place(entry),
          entry.excerpt ? excerpt(entry.excerpt) : ''))));
    if (grade.refused) {
      parts.push(make('p', {class: 'bad'}, say('not-graded-reason', {reason: reasonOf(grade)}) + '.'));
      if (grade.similarity !== undefined)
        parts.push(make('p', {}, say('similarity', {share: number(100 * grade.similarity)}) + '.'), comparison(task));
      return;
    }
    if (!grade.findings.length && !grade.diagnostics.length && grade.points === grade.most)
      parts.push(make('p', {class: 'good'}, say('nothing-differs') + '.'));
    parts.push(comparison(task));
    parts.push(make('h3', {}, say('points')), make('table', {class: 'points'}, ...grade.criteria.map((entry) =>
      make('tr', {}, make('td', {}, entry.measure),
        make('td', {}, make('div', {class: 'bar'}, bar(entry.most ? 100 * entry.points / entry.most : 0))),
        make('td', {}, entry.state === 'open' ? \`open / \${number(entry.most)}\` : \`\${number(entry.points)} / \${number(entry.most)}\`),
        entry.text ? requirement(entry) : make('td', {class: 'dim'}, entry.reason)))));
    if (grade.penalty) parts.push(make('p', {class: 'bad'}, say('diagnostics-cost', {points: number(grade.penalty)}) + '.'));
  });
  return parts.filter(Boolean);
}

/** "5 submissions, 3 passed, 1 could not be graded, median 61 of 100 points", of those that were graded. */
function summaryOf(all) {
  const graded = all.filter((one) => one.tasks.length);
  if (!graded.length) return all.length ? '' : say('no-submissions');
  const points = graded.filter((one) => !one.unread).map((one) => one.points).sort((a, b) => a - b);
  const middle = points.length >> 1, median = points.length % 2 ? points[middle] : (points[middle - 1] + points[middle]) / 2;
  const unread = graded.filter((one) => one.unread).length, most = Math.max(...graded.map((one) => one.most));
  const passed = graded.filter((one) => one.passed).length;
  return [graded.length > 1 ? say('submissions-count', {count: graded.length}) : say('one-submission'), say('passed-count', {count: passed}),
    unread && say('unread-count', {count: unread}),
    points.length && say('median', {median: number(median), most: number(most)})].filter(Boolean).join(', ');
}

/**
 * Puts the summary and the filter into \`head\`, the table and the details into \`body\`, and listens to keys in
 * \`keys\`. \`show\` takes the submissions, \`{id, name, identifier, points, most, passed, state, tasks}\` (state: why
 * there are no tasks yet), \`choose\` the number of one. Tasks hold a grade or a failure, and give pictures, two a view.
 * \`translation\` has the words of another language by their ids.
 */
export function gradesView({head, body, keys, chosen = () => {}, translation = {}}) {
  words = {...english, ...translation};
  const summary = make('p', {id: 'summary'});
  const filter = make('input', {id: 'filter', type: 'search', placeholder: say('filter-hint'), autocomplete: 'off'});
  const names = {name: say('submission-head'), points: say('points'), result: say('result'), first: say('finding')};
  const heads = Object.keys(names).map((key) => make('th', {'aria-sort': 'none', 'data-key': key},
    make('button', {type: 'button', onclick: () => sortBy(key)}, names[key])));
  const rows = make('tbody'), none = make('p', {hidden: ''}, say('no-match') + '.');
  const detail = make('section', {id: 'detail', 'aria-label': say('details'), 'aria-live': 'polite', tabindex: '-1'}, make('p', {class: 'hint'},
    say('choose') + '.'));
  head.append(summary, make('label', {}, say('filter') + ' ', filter));
  body.append(make('section', {id: 'list', 'aria-label': say('submissions')},
    make('table', {}, make('thead', {}, make('tr', {}, ...heads)), rows), none), detail);
  const state = {key: 'name', up: true, chosen: -1, all: [], shown: []};

  function list() {
    const words = filter.value.toLowerCase().split(/\\s+/).filter(Boolean);
    state.shown = state.all.filter((one) => words.every((word) => one.text.includes(word)));
    const value = (one) => state.key === 'name' ? (one.name || one.id).toLowerCase() : one[state.key];
    state.shown.sort((a, b) => {
      const x = value(a), y = value(b);
      const order = typeof x === 'string' ? x.localeCompare(y) : Number(x) - Number(y);
      return (state.up ? order : -order) || a.index - b.index;
    });
    rows.replaceChildren(...state.shown.map((one) => make('tr', {
      tabindex: one.index === state.chosen || (state.chosen < 0 && one === state.shown[0]) ? '0' : '-1',
      'aria-selected': String(one.index === state.chosen), 'data-index': one.index,
      onclick: () => choose(one.index),
    }, make('td', {}, one.name || one.id,
            one.name ? make('div', {class: 'dim'}, one.identifier || one.id) : ''),
       make('td', {}, one.unread ? '–' : one.most ? \`\${number(one.points)} / \${number(one.most)}\` : '–'),
       make('td', {class: one.state ? 'dim' : one.passed ? 'good' : 'bad'}, one.result),
       one.first ? make('td', {}, one.first)
         : make('td', {class: 'dim'}, one.tasks.length && one.points === one.most ? say('as-reference') : '–'))));
    none.hidden = state.shown.length > 0 || state.all.length === 0;
    for (const cell of heads) cell.setAttribute('aria-sort', cell.dataset.key !== state.key ? 'none' : state.up ? 'ascending' : 'descending');
  }

  function sortBy(key) {
    state.up = state.key === key ? !state.up : key !== 'points';
    state.key = key;
    list();
  }

  function choose(index, focus = true) {
    state.chosen = index;
    for (const row of rows.children) {
      const here = Number(row.dataset.index) === index;
      row.setAttribute('aria-selected', String(here));
      row.tabIndex = here ? 0 : -1;
      if (here && focus) row.focus();
    }
    detail.replaceChildren(...detailOf(state.all[index]));
    chosen(state.all[index]);
  }

  filter.addEventListener('input', list);
  keys.addEventListener('keydown', (event) => {
    // Up and down go to the next submission from the slider too: left and right move it.
    const sliding = event.target.type === 'range' && /^Arrow(Up|Down)$/.test(event.key);
    if (event.target instanceof HTMLInputElement && !sliding) {
      if (event.key === 'Escape') event.target.blur();
      return;
    }
    if (event.key === '/') {
      event.preventDefault();
      filter.focus();
      return;
    }
    const step = {ArrowDown: 1, j: 1, ArrowUp: -1, k: -1}[event.key];
    if (!step || !state.shown.length || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const at = state.shown.findIndex((one) => one.index === state.chosen);
    const next = Math.min(state.shown.length - 1, Math.max(0, at < 0 ? 0 : at + step));
    choose(state.shown[next].index);
  });
  return {
    choose,
    show(all) {
      const before = state.all[state.chosen];
      state.all = all.map(rowOf);
      state.chosen = before ? state.all.findIndex((one) => one.id === before.id) : -1;
      summary.textContent = summaryOf(state.all);
      list();
      // What is read is not drawn anew unless it has changed.
      const after = state.all[state.chosen];
      if (before && !after) detail.replaceChildren();
      else if (after && after.tasks !== before.tasks) detail.replaceChildren(...detailOf(after));
    },
  };
}
`;function Ds({submission:e,points:t,most:n,passed:s,graded:i,overridden:o,comments:a,tasks:u}){return{id:e.id,name:e.name,...e.identifier?{identifier:e.identifier}:{},points:t,most:n,passed:s,graded:i,...o?{overridden:!0}:{},...a.length>0?{comments:a}:{},tasks:u.map(({task:c,grade:d,failure:m})=>({...c?{task:c}:{},...m?{failure:m}:{grade:d??null}}))}}var xi=({title:e,tasks:t,marks:n})=>`{"title":${JSON.stringify(e)},
"rubric":${JSON.stringify(T.value[0])},
"tasks":${JSON.stringify(t)},
"submissions":[
${n.map(s=>JSON.stringify(Ds(s))).join(`,
`)}
]}
`,Si={pt:()=>import("./pt-5NSIPD54.js"),es:()=>import("./es-IXW4PD6U.js"),cs:()=>import("./cs-JDXSDPJF.js")},Ci=async e=>e==="en"?{}:JSON.parse((await Si[e]()).default),As=e=>JSON.stringify(e).replaceAll("<","\\u003c");async function Mi(e){if(!e)return"";let t=new Uint8Array(await e.arrayBuffer()),n="";for(let s=0;s<t.length;s+=8192)n+=String.fromCharCode(...t.subarray(s,s+8192));return`data:${e.type||"image/jpeg"};base64,${btoa(n)}`}var Ri=e=>Promise.all(e.map(Mi)),Es=async(e,t)=>`<script type="application/json" class="pictures" id="${e}">${JSON.stringify(await Ri(t))}<\/script>
`,Ti=e=>(e??[]).flatMap(({picture:t,heat:n})=>[t,n]);function Ht(e,t){let n=e.indexOf(t);return[e.slice(0,n),e.slice(n+t.length)]}async function qs(e){let[t,n]=Ht(Bs,"/*STYLE*/"),[s,i]=Ht(n,"<!--DATA-->"),[o,a]=Ht(i,"/*SCRIPT*/"),u=[t,Ls,Gs,s],c=Xt.value,d={title:e.title,tasks:e.tasks,language:c,words:await Ci(c)};u.push(`<script type="application/json" id="class">${As(d)}<\/script>
`);for(let[m,{name:p}]of b.value.entries())u.push(new Blob([await Es(`r${m}`,await Z.get(p)??[])]));for(let[m,p]of e.marks.entries()){u.push(new Blob([`<script type="application/json" class="submission">${As(Ds(p))}<\/script>
`]));for(let[g,{name:f}]of b.value.entries())u.push(new Blob([await Es(`p${m}-${g}`,Ti(await Y.get(Q(f,p.submission.id))))]))}return u.push(o,Is,js,a),new Blob(u,{type:"text/html"})}async function $i(e,t){let n=new mn,s=new Set;for(let[i,o]of e.marks.entries()){let a=await qs({...e,marks:[o]});for(let{name:u,identifier:c}of Pe(e.groups,o.submission)){let d=c.replace(/^participant /i,""),m=d?`${u}_${d}_assignsubmission_file_`:o.submission.id;s.has(m)||await n.add(`${m}/feedback.html`,a),s.add(m)}t(i+1)}return n.finish()}var _s=["moodle","criteria","html","feedback","json","junit","overrides"],Vt={moodle:"grades.csv",criteria:"criteria.csv",html:"report.html",feedback:"feedback.zip",json:"report.json",junit:"junit.xml",overrides:"overrides.csv"},Ks=(e,t)=>({title:T.value[0]?.title??"",tasks:le.value,groups:t,marks:e});async function Js(e,t,n,s){let i=(o,a)=>new Blob([o],{type:a});switch(e){case"moodle":return i(ys(t),"text/csv");case"criteria":return i(ks(t),"text/csv");case"overrides":return i(ws(n),"text/csv");case"json":return i(xi(t),"application/json");case"junit":return i(Cs(t),"application/xml");case"html":return qs(t);case"feedback":return $i(t,s)}}var Pi={moodle:x("Moodle’s grading worksheet"),criteria:x("a column for each task and criterion"),html:x("a page with all images, for reading"),feedback:x("a page for each student, for Moodle"),json:x("everything but the images, for programs"),junit:x("JUnit’s XML, for CI services"),overrides:x("marks and comments by hand")},ut=y("");async function Oi(e){let t=Vt[e];ut.value=l("Writing {file}…",{file:t});try{let n=s=>void(ut.value=l("Writing {file}: {done} of {all}",{file:t,done:s,all:$.value.length}));_e(await Js(e,Ks($.value,H.value),N.value,n),t)}catch(n){fe(l("{file} was not written: {reason}",{file:t,reason:n.message}))}ut.value=""}function Fi(){return $.value.some(He)?r("details",{class:"exports",onKeyDown:e=>{e.key==="Escape"&&(e.currentTarget.open=!1,e.currentTarget.querySelector("summary")?.focus())},children:[r("summary",{class:"button",children:[r(K,{name:"download"}),l("Save as")]}),r("ul",{children:_s.map(e=>r("li",{children:r("button",{type:"button",class:"plain",onClick:t=>{t.currentTarget.closest("details").open=!1,Oi(e)},children:[r("b",{children:Vt[e]})," ",r("small",{class:"note",children:l(Pi[e])})]})},e))})]}):null}function Ws(){return Le.value==="kept"?null:r("p",{class:"warning",role:"status",children:Le.value==="full"?l("The browser has no more room: what is not kept is lost by a reload. Save the marks as files, or forget other classes."):l("The browser keeps nothing of this page (a private window?): a reload loses the class. Save the marks as files.")})}function Hs(){let e=ve.value,t=Nt.value.length,n=W.value.size,s=b.value.some((i,o)=>T.value[o]&&!ke(i,T.value[o]));return b.value.length===0||C.value.length===0?r(Ws,{}):r(S,{children:[r("div",{class:"go",children:e?r(S,{children:[r("progress",{value:e.done,max:e.all,"aria-label":l("Progress")}),r("span",{role:"status",children:l("Grading {done} of {all}…",{done:e.done,all:e.all})}),r("button",{type:"button",class:"button",onClick:Bt,children:l("Cancel")})]}):r(S,{children:[r("button",{type:"button",class:"button primary",...an(t>0&&!s,()=>void et()),children:n===0?l("Grade"):t>0?l("Go on: {count} left",{count:t}):l("All is graded")}),r(Fi,{}),n>0&&r("button",{type:"button",class:"link",onClick:()=>{Qe(),et()},children:l("Grade all again")}),r("span",{class:"note",role:"status",children:ut.value||(n>0?L(qn.value-t,"{count} graded.","{count} graded."):"")})]})}),ye.value&&r("p",{class:"problem",role:"alert",children:ye.value}),!e&&we.value>0&&r("p",{class:"warning",role:"status",children:[L(we.value,"{count} grade is by an earlier rubric: the new one asks the service to render again.","{count} grades are by an earlier rubric: the new one asks the service to render again.")," ",r("button",{type:"button",class:"link",onClick:()=>void et(),children:l("Grade these again")})]}),r(Ws,{})]})}function Vs({kind:e,title:t,text:n,take:s,children:i}){let o=a=>void $e(a).then(s);return r("section",{class:"drop-box","aria-labelledby":`${e}-title`,...ln(a=>void s(a)),children:[r("h2",{id:`${e}-title`,children:t}),r("p",{children:n}),i,r("div",{class:"buttons",children:[r("button",{type:"button",class:"button small",onClick:()=>o(!1),"aria-label":l("{title}: choose files",{title:t}),children:[r(K,{name:"upload"}),l("Choose files")]}),r("button",{type:"button",class:"button small",onClick:()=>o(!0),"aria-label":l("{title}: choose a folder",{title:t}),children:l("Choose a folder")})]})]})}function Ni(){return b.value.length===0?null:r("ul",{class:"taken",children:b.value.map((e,t)=>{let n=T.value[t];return r("li",{children:[r("b",{children:e.name})," ",e.rubric&&r("span",{class:"note",children:l("rubric {name}",{name:e.rubric.name})}),n&&!ke(e,n)&&r("span",{class:"bad",children:[" ",l("needs a reference")]}),!e.reference&&n&&ke(e,n)&&r("span",{class:"note",children:[" ",l("graded without a reference")]}),b.value.length>1&&r(se,{icon:"close",label:l("Remove {name}",{name:e.name}),onClick:()=>Kn(e.name)})]},e.name)})})}var Li=()=>void requestAnimationFrame(()=>document.querySelector(".go .primary")?.focus());function zt(){let e=b.value.length>0,t=C.value.length;return r(S,{children:[r("div",{class:"drops",children:[r(Vs,{kind:"reference",title:l("Reference"),take:n=>Jt(n),text:l("A scene, a zip or folder of it and its files, or an image; or a folder with one for each task."),children:[r(Ni,{}),e&&r("button",{type:"button",class:"link",onClick:()=>void $e(!1).then(n=>Jt(n,!0)),children:l("Add a task")})]}),r(Vs,{kind:"submissions",title:l("Submissions"),take:lt,text:l("Moodle’s zip of the class, or scenes, archives and images, or a folder with one for each student. Rubrics (.json), overrides.csv and groups.csv may lie beside them."),children:[t>0&&r("p",{class:"taken",children:[r("b",{children:L(t,"{count} submission","{count} submissions")}),H.value.length>0&&r("span",{class:"note",children:[" ",L(H.value.length,"{count} row of groups.csv","{count} rows of groups.csv")]}),N.value.length>0&&r("span",{class:"note",children:[" ",L(N.value.length,"{count} mark or comment by hand","{count} marks or comments by hand")]})]}),r(on,{label:l("A missing or damaged file gives no points"),checked:oe.value==="error",onChange:n=>{oe.value=n?"error":"placeholder",Qe()}})]})]}),te.value&&r("p",{role:"status",class:"note",children:te.value}),X.value.length>0&&r("div",{role:"alert",class:"problem",children:X.value.map(n=>r("p",{children:n},n))}),!e&&t===0&&!te.value&&r("p",{class:"try",children:[r("button",{type:"button",class:"button",onClick:()=>void Ps().then(Li),children:l("Try an example class")}),r("span",{class:"note",children:l("Seven students, two tasks, some mistakes: nothing to prepare.")})]})]})}function zs(){if(b.value.length+C.value.length+W.value.size===0)return null;let e=async()=>{window.confirm(l("Forget the class: submissions, marks and comments? What was saved as a file stays."))&&(zn(),fe(await Hn()?l("The class is forgotten."):l("The browser refused to forget: clear the data of this site in its settings.")))};return r("button",{type:"button",class:"link",onClick:()=>void e(),children:l("Forget this class")})}var I=y("details"),ct=y("");function Us(e){let t=e.target;if(t.matches("input:not([type=range]):not([type=checkbox]), textarea, select")){e.key==="Escape"&&t.id==="filter"&&t.blur();return}if(e.ctrlKey||e.metaKey||e.altKey||t.closest(".lines, .exports[open], [role=tablist]"))return;if(e.key==="/"){e.preventDefault(),document.getElementById("filter")?.focus();return}let s={ArrowDown:1,j:1,ArrowUp:-1,k:-1}[e.key];s===void 0||D.value.length===0||(e.preventDefault(),De(s))}function Bi(){let e=(t,n)=>r("button",{type:"button",role:"tab",id:`tab-${t}`,"aria-controls":`panel-${t}`,"aria-selected":I.value===t,tabIndex:I.value===t?0:-1,onClick:()=>{t==="rubric"&&I.value!=="rubric"&&Ie(),I.value=t},children:n});return r("div",{class:"panels",children:[r("div",{class:"panel-tabs",role:"tablist","aria-label":l("Panels"),onKeyDown:t=>{t.key!=="ArrowLeft"&&t.key!=="ArrowRight"||(I.value==="details"&&Ie(),I.value=I.value==="details"?"rubric":"details",document.getElementById(`tab-${I.value}`)?.focus())},children:[e("details",l("Details")),e("rubric",l("Rubric"))]}),r("div",{role:"tabpanel",id:`panel-${I.value}`,"aria-labelledby":`tab-${I.value}`,children:I.value==="details"?r(ds,{}):r(Ns,{})},I.value)]})}function Nl(){B(()=>(document.title=`${l("Grade")} · Farol`,_n().catch(()=>ct.value=l("The server did not send its tables. Load the page again.")),window.addEventListener("keydown",Us),()=>window.removeEventListener("keydown",Us)),[]);let e=$.value.length>0,t=b.value.length>0&&T.value.length>0;return r("main",{class:e?"grade with-class":"grade",id:"main",children:[r("div",{class:"lead",children:[r("h1",{children:l("Grade")}),r("p",{children:[l("Compares scenes with a reference: the images, the geometry and the XML. The service stores nothing; the class stays in this browser.")," ",r(zs,{})]})]}),ct.value&&r("p",{class:"problem",role:"alert",children:ct.value}),ae.value?r("p",{class:"note",role:"status",children:ct.value?"":l("Loading…")}):r(S,{children:[e?r("details",{class:"setup",open:!st.value&&$.value.every(({graded:n})=>!n),children:[r("summary",{children:l("Reference and submissions")}),r(zt,{})]}):r(zt,{}),r(Hs,{}),(e||t&&C.value.length===0)&&r(S,{children:[e&&r(ls,{}),r("div",{class:e?"class":"class alone",children:[e&&r(us,{}),r(Bi,{})]})]})]})]})}export{Nl as GradePage};
