! RAPID Kernel, Parameter declarations: every mode, optional or not, with and without comma.
MODULE forms
  VAR num n:=1;
  PERS num kept:=2;
  VAR num list{1}:=[3];
  VAR num table{1,1}:=[[4]];

  PROC main()
    first\a:=1,2,\c:=n\d:=kept,n;
    TPWrite ValToStr(n)+ValToStr(kept);   ! -> 56
    second\list:=list\table:=table;
    second;
  ENDPROC

  PROC first(\num a,num b,\VAR num c\PERS num d,INOUT num e)
    e:=4;
    c:=c+a;
    d:=d+b+2;
  ENDPROC

  PROC second(\num list{*}|VAR num other\VAR num table{*,*}|num last)
    IF Present(list) AND Present(table) TPWrite ValToStr(list)+ValToStr(table); ! -> [3][[4]]
  ENDPROC
ENDMODULE
