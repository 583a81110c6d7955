const read = (element) => JSON.parse(element.textContent);
const about = read(document.getElementById('class'));
const pictures = (id) => {
  const element = document.getElementById(id);
  return element ? read(element) : [];
};
const submissions = [...document.querySelectorAll('script.submission')].map((element, index) => {
  const one = read(element);
  one.tasks.forEach((task, number) => {
    task.references = () => pictures(`r${number}`);
    task.pictures = () => pictures(`p${index}-${number}`);
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
