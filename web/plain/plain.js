// Lists the served scenes; a click shows the image of one.
const note = document.getElementById('note'), list = document.getElementById('scenes'), picture = document.getElementById('picture');

function entry({ title, valid, links, problem }) {
  const item = document.createElement('li');
  if (!valid) {
    item.className = 'bad';
    item.textContent = `${title}: ${problem?.message ?? 'this scene cannot be read'}`;
    return item;
  }
  const link = document.createElement('a'), image = new Image(320, 240);
  link.href = links.image;
  image.loading = 'lazy';
  image.alt = '';
  image.src = links.thumbnail;
  link.append(image, title);
  link.addEventListener('click', (event) => {
    event.preventDefault();
    Object.assign(picture, { src: links.image, alt: title, hidden: false });
    picture.scrollIntoView();
  });
  item.append(link);
  return item;
}

try {
  for (let page = 1, pages = 1; page <= pages; ++page) {
    const response = await fetch(`v1/scenes?page=${page}`);
    if (!response.ok) throw new Error(`the server answered ${response.status}`);
    const answer = await response.json();
    list.append(...answer.scenes.map(entry));
    pages = answer.pages;
  }
  note.textContent = list.children.length ? '' : 'This server serves no scenes. Start it with --scenes FOLDER.';
} catch (fault) {
  note.textContent = `The scenes cannot be listed: ${fault.message}.`;
}
