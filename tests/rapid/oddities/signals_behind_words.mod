! Field practice, Signals: no station declares one here. What is spelt like one is one, also behind the
! word of another language (entrada, salida); all signals are 0.
MODULE signals_behind_words
  VAR num passes:=0;

  PROC main()
    IF EntDI_1=1 passes:=10;              ! warning: I801
    IF SalidaDO2=0 passes:=passes+1;      ! warning: I801
    TPWrite "passes "\Num:=passes;        ! -> passes 1
  ENDPROC
ENDMODULE
