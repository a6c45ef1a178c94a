import { currentLanguage, setLanguage } from './messages';

/** Uses the language and the theme that were chosen last, or those of the system. */
export function applyPreferences(): void {
  setLanguage(currentLanguage());
  document.documentElement.dataset.theme =
    localStorage.getItem('frangia-theme') ?? (matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');
}
export function toggleTheme(): void {
  const theme = document.documentElement.dataset.theme === 'light' ? 'dark' : 'light';
  document.documentElement.dataset.theme = theme;
  localStorage.setItem('frangia-theme', theme);
}
