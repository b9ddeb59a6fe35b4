// What the page says where there is no face to show.
export const at = (id) => document.getElementById(id);

const message = at('message');

export function say(text, className = '') {
  message.textContent = text;
  message.className = className;
}

export function complain(error) {
  say(error.message, 'error');
}

const isError = () => message.className === 'error';

/** Takes an error away, and nothing else; with a text that one alone. */
export function dismiss(text = message.textContent) {
  if (isError() && message.textContent === text) say('');
}

/** Takes anything away but an error; there may be one to tell instead. */
export function hush(error) {
  if (!isError()) say(error, error && 'error');
}
