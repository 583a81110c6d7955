// Texts of the student page in each language; those of findings come from the server.
import type { Language } from '../words.ts';

export interface Texts {
  about: string;
  code: string;
  codeHint: string;
  scene: string;
  drop: string;
  chooseFiles: string;
  chooseFolder: string;
  check: string;
  checking: string;
  noScene: string;
  missing: string;
  opens: (time: string) => string;
  closes: (time: string) => string;
  closed: (time: string) => string;
  tries: (left: number) => string;
  next: (time: string) => string;
  result: string;
  points: (from: number, to: number) => string;
  requirements: string;
  met: string;
  partly: string;
  unmet: string;
  differs: string;
  nothingDiffers: string;
  document: string;
  nothingFound: string;
  image: string;
  imageText: string;
  mask: string;
  maskText: string;
  line: (line: number) => string;
  noAnswer: string;
}

const texts: Record<Language, Texts> = {
  en: {
    about: 'Check your scene before you hand it in. The check shows how far you are, and where to look.',
    code: 'Your code',
    codeHint: 'Your teacher gave it to you.',
    scene: 'Your scene',
    drop: 'Drop an .xml file, a zip, or a folder here.',
    chooseFiles: 'Choose files',
    chooseFolder: 'Choose a folder',
    check: 'Check',
    checking: 'Checking… this takes some seconds.',
    noScene: 'There is no single scene among these files.',
    missing: 'There is no such assignment.',
    opens: (time) => `Opens ${time}`,
    closes: (time) => `Open until ${time}`,
    closed: (time) => `Closed since ${time}`,
    tries: (left) => (left === 1 ? '1 check left' : `${left} checks left`),
    next: (time) => `next one from ${time}`,
    result: 'Result',
    points: (from, to) => `${from} to ${to} % of the points`,
    requirements: 'Requirements',
    met: 'met',
    partly: 'partly met',
    unmet: 'not met',
    differs: 'Where it differs',
    nothingDiffers: 'No place was found.',
    document: 'Your document',
    nothingFound: 'No errors or warnings.',
    image: 'Your image',
    imageText: 'Image of your scene',
    mask: 'Parts of the image that differ',
    maskText: 'Grid of the image: filled cells differ',
    line: (line) => `line ${line}`,
    noAnswer: 'The server does not answer.',
  },
  pt: {
    about: 'Verifique a sua cena antes de a entregar. A verificação mostra quanto já está feito e onde procurar.',
    code: 'O seu código',
    codeHint: 'Foi o professor que lho deu.',
    scene: 'A sua cena',
    drop: 'Largue aqui um ficheiro .xml, um zip ou uma pasta.',
    chooseFiles: 'Escolher ficheiros',
    chooseFolder: 'Escolher uma pasta',
    check: 'Verificar',
    checking: 'A verificar… demora alguns segundos.',
    noScene: 'Não há uma única cena entre estes ficheiros.',
    missing: 'Não há nenhuma tarefa com este nome.',
    opens: (time) => `Abre a ${time}`,
    closes: (time) => `Aberta até ${time}`,
    closed: (time) => `Fechada desde ${time}`,
    tries: (left) => (left === 1 ? 'Resta 1 verificação' : `Restam ${left} verificações`),
    next: (time) => `a próxima a partir de ${time}`,
    result: 'Resultado',
    points: (from, to) => `${from} a ${to} % dos pontos`,
    requirements: 'Requisitos',
    met: 'cumprido',
    partly: 'cumprido em parte',
    unmet: 'não cumprido',
    differs: 'Onde é diferente',
    nothingDiffers: 'Não se encontrou nenhum lugar.',
    document: 'O seu documento',
    nothingFound: 'Sem erros nem avisos.',
    image: 'A sua imagem',
    imageText: 'Imagem da sua cena',
    mask: 'Partes da imagem que são diferentes',
    maskText: 'Grelha da imagem: as células preenchidas são diferentes',
    line: (line) => `linha ${line}`,
    noAnswer: 'O servidor não responde.',
  },
  es: {
    about: 'Compruebe su escena antes de entregarla. La comprobación muestra cuánto está hecho y dónde mirar.',
    code: 'Su código',
    codeHint: 'Se lo dio su profesor.',
    scene: 'Su escena',
    drop: 'Suelte aquí un archivo .xml, un zip o una carpeta.',
    chooseFiles: 'Elegir archivos',
    chooseFolder: 'Elegir una carpeta',
    check: 'Comprobar',
    checking: 'Comprobando… tarda unos segundos.',
    noScene: 'No hay una única escena entre estos archivos.',
    missing: 'No hay ninguna tarea con este nombre.',
    opens: (time) => `Se abre el ${time}`,
    closes: (time) => `Abierta hasta el ${time}`,
    closed: (time) => `Cerrada desde el ${time}`,
    tries: (left) => (left === 1 ? 'Queda 1 comprobación' : `Quedan ${left} comprobaciones`),
    next: (time) => `la próxima a partir del ${time}`,
    result: 'Resultado',
    points: (from, to) => `${from} a ${to} % de los puntos`,
    requirements: 'Requisitos',
    met: 'cumplido',
    partly: 'cumplido en parte',
    unmet: 'no cumplido',
    differs: 'Dónde difiere',
    nothingDiffers: 'No se encontró ningún lugar.',
    document: 'Su documento',
    nothingFound: 'Sin errores ni avisos.',
    image: 'Su imagen',
    imageText: 'Imagen de su escena',
    mask: 'Partes de la imagen que difieren',
    maskText: 'Cuadrícula de la imagen: las celdas rellenas difieren',
    line: (line) => `línea ${line}`,
    noAnswer: 'El servidor no responde.',
  },
  cs: {
    about: 'Zkontrolujte svou scénu, než ji odevzdáte. Kontrola ukáže, jak daleko jste a kam se podívat.',
    code: 'Váš kód',
    codeHint: 'Dostali jste ho od učitele.',
    scene: 'Vaše scéna',
    drop: 'Přetáhněte sem soubor .xml, zip nebo složku.',
    chooseFiles: 'Vybrat soubory',
    chooseFolder: 'Vybrat složku',
    check: 'Zkontrolovat',
    checking: 'Kontroluje se… trvá to několik sekund.',
    noScene: 'Mezi soubory není právě jedna scéna.',
    missing: 'Taková úloha tu není.',
    opens: (time) => `Otevře se ${time}`,
    closes: (time) => `Otevřeno do ${time}`,
    closed: (time) => `Uzavřeno od ${time}`,
    tries: (left) => `Zbývající kontroly: ${left}`,
    next: (time) => `další od ${time}`,
    result: 'Výsledek',
    points: (from, to) => `${from} až ${to} % bodů`,
    requirements: 'Požadavky',
    met: 'splněno',
    partly: 'splněno zčásti',
    unmet: 'nesplněno',
    differs: 'Kde se liší',
    nothingDiffers: 'Žádné místo se nenašlo.',
    document: 'Váš dokument',
    nothingFound: 'Bez chyb a varování.',
    image: 'Váš obrázek',
    imageText: 'Obrázek vaší scény',
    mask: 'Části obrázku, které se liší',
    maskText: 'Mřížka obrázku: vyplněná pole se liší',
    line: (line) => `řádek ${line}`,
    noAnswer: 'Server neodpovídá.',
  },
};

export const textsOf = (of: Language): Texts => texts[of];
