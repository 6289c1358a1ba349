! Field practice, Routine heads: blanks and line ends where they please.
MODULE blank_before_parenthesis
  PROC main ()
    show ( 1 );
    TPWrite ValToStr ( twice ( 2 ) );     ! -> 4
  ENDPROC

  PROC show (
    num a,
    \switch fast
    | switch slow
  )
    TPWrite "shown";                      ! -> shown
  ENDPROC

  FUNC num twice ( num a )
    RETURN ( 2 * a );
  ENDFUNC
ENDMODULE
