MODULE Algorithms
  ! Data and logic without a move: sorting, searching, primes, matrices, texts, a queue, recursion.
  ! Each lesson prints what it found.
  !
  !   rapidsim run programs/algorithms.mod --no-record

  RECORD order
    string part;
    num pieces;
    bool urgent;
  ENDRECORD

  CONST num PRIME_LIMIT:=500;
  CONST num LIST_SIZE:=40;
  CONST num QUEUE_SIZE:=4;

  VAR num unsorted{LIST_SIZE};
  VAR bool composite{PRIME_LIMIT};

  ! The queue is a ring: `queue_first` is where the next order is taken.
  VAR order queue{QUEUE_SIZE};
  VAR num queue_first:=1;
  VAR num queue_length:=0;
  VAR errnum ERR_QUEUE_FULL:=-1;
  VAR errnum ERR_QUEUE_EMPTY:=-1;

  PROC main()
    sorting_lesson;
    prime_lesson;
    matrix_lesson;
    text_lesson;
    queue_lesson;
    recursion_lesson;
    number_lesson;
  ENDPROC

  ! --- Sorting and searching

  PROC sorting_lesson()
    VAR num by_insertion{LIST_SIZE};
    VAR num by_parts{LIST_SIZE};

    fill_list unsorted, 7;
    by_insertion:=unsorted;
    by_parts:=unsorted;
    TPWrite "unsorted "\Num:=checksum(unsorted);
    sort_by_insertion by_insertion;
    TPWrite "sorted "\Num:=checksum(by_insertion);
    sort_by_parts by_parts, 1, LIST_SIZE;
    TPWrite "both agree "\Bool:=checksum(by_parts)=checksum(by_insertion);
    TPWrite "smallest, median, largest "+ValToStr(by_parts{1})+" "
      +ValToStr(by_parts{LIST_SIZE DIV 2})+" "+ValToStr(by_parts{LIST_SIZE});
    TPWrite "found at "\Num:=place_in(by_parts, unsorted{5});
    TPWrite "not found "\Num:=place_in(by_parts, -1);
  ENDPROC

  ! Numbers that look random: a small linear congruential generator.
  PROC fill_list(INOUT num list{*}, num seed)
    VAR num value;

    value:=seed;
    FOR i FROM 1 TO Dim(list, 1) DO
      value:=(value*137+187) MOD 1021;
      list{i}:=value;
    ENDFOR
  ENDPROC

  ! Depends on the order, so that two equal sums mean two equal lists.
  FUNC num checksum(num list{*})
    VAR num sum:=0;

    FOR i FROM 1 TO Dim(list, 1) DO
      sum:=(sum*31+list{i}) MOD 8191;
    ENDFOR
    RETURN sum;
  ENDFUNC

  PROC sort_by_insertion(INOUT num list{*})
    VAR num value;
    VAR num hole;
    VAR bool moving;

    FOR i FROM 2 TO Dim(list, 1) DO
      value:=list{i};
      hole:=i;
      moving:=TRUE;
      WHILE moving DO
        IF list{hole-1}>value THEN
          list{hole}:=list{hole-1};
          hole:=hole-1;
          moving:=hole>1;
        ELSE
          moving:=FALSE;
        ENDIF
      ENDWHILE
      list{hole}:=value;
    ENDFOR
  ENDPROC

  ! Quicksort between two places, both included.
  PROC sort_by_parts(INOUT num list{*}, num first, num last)
    VAR num pivot;
    VAR num low;
    VAR num high;

    IF first>=last RETURN;
    pivot:=list{(first+last) DIV 2};
    low:=first;
    high:=last;
    WHILE low<=high DO
      WHILE list{low}<pivot DO
        Incr low;
      ENDWHILE
      WHILE list{high}>pivot DO
        Decr high;
      ENDWHILE
      IF low<=high THEN
        exchange list{low}, list{high};
        Incr low;
        Decr high;
      ENDIF
    ENDWHILE
    sort_by_parts list, first, high;
    sort_by_parts list, low, last;
  ENDPROC

  PROC exchange(INOUT num a, INOUT num b)
    VAR num old_a;

    old_a:=a;
    a:=b;
    b:=old_a;
  ENDPROC

  ! Binary search in a sorted list; 0 when the value is not there.
  FUNC num place_in(num list{*}, num wanted)
    VAR num low:=1;
    VAR num high;
    VAR num middle;

    high:=Dim(list, 1);
    WHILE low<=high DO
      middle:=(low+high) DIV 2;
      IF list{middle}=wanted THEN
        RETURN middle;
      ELSEIF list{middle}<wanted THEN
        low:=middle+1;
      ELSE
        high:=middle-1;
      ENDIF
    ENDWHILE
    RETURN 0;
  ENDFUNC

  ! --- Primes

  PROC prime_lesson()
    TPWrite "primes "\Num:=count_primes();
    TPWrite "twins "\Num:=count_twins();
  ENDPROC

  ! The sieve of Eratosthenes leaves `composite` behind.
  FUNC num count_primes()
    VAR num found:=0;
    VAR num multiple;

    FOR i FROM 1 TO PRIME_LIMIT DO
      composite{i}:=i=1;
    ENDFOR
    FOR i FROM 2 TO PRIME_LIMIT DO
      IF NOT composite{i} THEN
        found:=found+1;
        multiple:=i*i;
        WHILE multiple<=PRIME_LIMIT DO
          composite{multiple}:=TRUE;
          multiple:=multiple+i;
        ENDWHILE
      ENDIF
    ENDFOR
    RETURN found;
  ENDFUNC

  FUNC num count_twins()
    VAR num found:=0;

    FOR i FROM 3 TO PRIME_LIMIT-2 DO
      IF NOT (composite{i} OR composite{i+2}) found:=found+1;
    ENDFOR
    RETURN found;
  ENDFUNC

  ! --- Matrices

  PROC matrix_lesson()
    VAR num a{6,6};
    VAR num b{6,6};
    VAR num c{6,6};

    FOR row FROM 1 TO 6 DO
      FOR column FROM 1 TO 6 DO
        a{row,column}:=1/(row+column-1);
        b{row,column}:=row-column/10;
      ENDFOR
    ENDFOR
    multiply a, b, c;
    TPWrite "first row "+ValToStr(c{1,1})+" "+ValToStr(c{1,2})+" "+ValToStr(c{1,6});
    TPWrite "trace "\Num:=trace_of(c);
    TPWrite "length of the last column "\Num:=column_length(c, 6);
  ENDPROC

  PROC multiply(num a{*,*}, num b{*,*}, INOUT num product{*,*})
    VAR num sum;

    FOR row FROM 1 TO Dim(a, 1) DO
      FOR column FROM 1 TO Dim(b, 2) DO
        sum:=0;
        FOR k FROM 1 TO Dim(b, 1) DO
          sum:=sum+a{row,k}*b{k,column};
        ENDFOR
        product{row,column}:=sum;
      ENDFOR
    ENDFOR
  ENDPROC

  FUNC num trace_of(num matrix{*,*})
    VAR num sum:=0;

    FOR i FROM 1 TO Dim(matrix, 1) DO
      sum:=sum+matrix{i,i};
    ENDFOR
    RETURN sum;
  ENDFUNC

  FUNC num column_length(num matrix{*,*}, num column)
    VAR num squares:=0;

    FOR i FROM 1 TO Dim(matrix, 1) DO
      squares:=squares+matrix{i,column}*matrix{i,column};
    ENDFOR
    RETURN Sqrt(squares);
  ENDFUNC

  ! --- Texts

  PROC text_lesson()
    TPWrite "roman "+roman(1994)+" "+roman(2024)+" "+roman(49);
    TPWrite "backwards "+backwards("simulated robot");
    TPWrite "packed "+packed("aaabccddddde");
    TPWrite "palindrome "\Bool:=backwards("reliefpfeiler")="reliefpfeiler";
  ENDPROC

  FUNC string roman(num value)
    CONST num worth{13}:=[1000,900,500,400,100,90,50,40,10,9,5,4,1];
    CONST string digits{13}:=["M","CM","D","CD","C","XC","L","XL","X","IX","V","IV","I"];
    VAR string text:="";
    VAR num rest;

    rest:=value;
    FOR i FROM 1 TO 13 DO
      WHILE rest>=worth{i} DO
        text:=text+digits{i};
        rest:=rest-worth{i};
      ENDWHILE
    ENDFOR
    RETURN text;
  ENDFUNC

  FUNC string backwards(string text)
    VAR string result:="";

    FOR i FROM StrLen(text) TO 1 STEP -1 DO
      result:=result+StrPart(text, i, 1);
    ENDFOR
    RETURN result;
  ENDFUNC

  ! Runs of equal letters as letter and count: "aaab" becomes "a3b1".
  FUNC string packed(string text)
    VAR string result:="";
    VAR string letter;
    VAR num run:=0;

    FOR i FROM 1 TO StrLen(text) DO
      letter:=StrPart(text, i, 1);
      run:=run+1;
      IF i=StrLen(text) THEN
        result:=result+letter+NumToStr(run, 0);
      ELSEIF StrPart(text, i+1, 1)<>letter THEN
        result:=result+letter+NumToStr(run, 0);
        run:=0;
      ENDIF
    ENDFOR
    RETURN result;
  ENDFUNC

  ! --- A queue of records, with errors of its own

  PROC queue_lesson()
    VAR order next;
    VAR num shipped:=0;

    BookErrNo ERR_QUEUE_FULL;
    BookErrNo ERR_QUEUE_EMPTY;
    accept ["flange",12,FALSE];
    accept ["bracket",3,TRUE];
    accept ["shaft",7,FALSE];
    accept ["cover",20,TRUE];
    ! The queue holds four: this one makes room first.
    accept ["gear",5,FALSE];
    WHILE queue_length>0 DO
      next:=first_order();
      TEST next.pieces
      CASE 3,5,7:
        TPWrite "small: "+next.part;
      DEFAULT:
        TPWrite "large: "+next.part;
      ENDTEST
      IF next.urgent next.pieces:=next.pieces+1;
      shipped:=shipped+next.pieces;
    ENDWHILE
    TPWrite "shipped "\Num:=shipped;
    next:=first_order();
    TPWrite "after the empty queue: "+next.part;
  ERROR
    IF ERRNO=ERR_QUEUE_EMPTY THEN
      TPWrite "nothing to do";
      TRYNEXT;
    ENDIF
  ENDPROC

  ! Puts an order at the end; if there is no room, the first one is dropped.
  PROC accept(order new)
    VAR order dropped;

    append new;
  ERROR
    IF ERRNO=ERR_QUEUE_FULL THEN
      dropped:=first_order();
      TPWrite "dropped "+dropped.part;
      RETRY;
    ENDIF
  ENDPROC

  PROC append(order new)
    VAR num last;

    IF queue_length=QUEUE_SIZE RAISE ERR_QUEUE_FULL;
    last:=(queue_first+queue_length-1) MOD QUEUE_SIZE+1;
    queue{last}:=new;
    queue_length:=queue_length+1;
  ERROR
    RAISE;
  ENDPROC

  FUNC order first_order()
    VAR order first;

    IF queue_length=0 RAISE ERR_QUEUE_EMPTY;
    first:=queue{queue_first};
    queue_first:=queue_first MOD QUEUE_SIZE+1;
    queue_length:=queue_length-1;
    RETURN first;
  ERROR
    RAISE;
  ENDFUNC

  ! --- Recursion

  PROC recursion_lesson()
    VAR num moved:=0;

    TPWrite "10! "\Num:=factorial(10);
    TPWrite "fibonacci "\Num:=fibonacci(12);
    TPWrite "common divisor "\Num:=common_divisor(1071, 462);
    move_tower 6, "left", "right", "middle", moved;
    TPWrite "discs moved "\Num:=moved;
    TPWrite "steps to one "\Num:=steps_to_one(27);
  ENDPROC

  FUNC num factorial(num n)
    IF n<=1 RETURN 1;
    RETURN n*factorial(n-1);
  ENDFUNC

  FUNC num fibonacci(num n)
    IF n<2 RETURN n;
    RETURN fibonacci(n-1)+fibonacci(n-2);
  ENDFUNC

  FUNC num common_divisor(num a, num b)
    IF b=0 RETURN a;
    RETURN common_divisor(b, a MOD b);
  ENDFUNC

  PROC move_tower(num discs, string from_peg, string to_peg, string over_peg, INOUT num moved)
    IF discs=0 RETURN;
    move_tower discs-1, from_peg, over_peg, to_peg, moved;
    moved:=moved+1;
    IF discs=6 TPWrite "the largest goes from "+from_peg+" to "+to_peg;
    move_tower discs-1, over_peg, to_peg, from_peg, moved;
  ENDPROC

  ! Halve what is even, else three times and one more.
  FUNC num steps_to_one(num start)
    VAR num value;
    VAR num turns:=0;

    value:=start;
    WHILE value<>1 DO
      IF value MOD 2=0 THEN
        value:=value DIV 2;
      ELSE
        value:=3*value+1;
      ENDIF
      turns:=turns+1;
    ENDWHILE
    RETURN turns;
  ENDFUNC

  ! --- What single precision does

  PROC number_lesson()
    VAR num sum:=0;
    VAR num big:=16777216;

    FOR i FROM 1 TO 1000 DO
      sum:=sum+0.1;
    ENDFOR
    TPWrite "a thousand tenths "\Num:=sum;
    TPWrite "is it 100? "\Bool:=sum=100;
    TPWrite "one more than 2^24 is lost "\Bool:=big+1=big;
    TPWrite "root "\Num:=root_of(2);
    TPWrite "quarter circle "\Num:=quarter_circle(200);
    TPWrite "harmonic "\Num:=harmonic(300);
    overflowing 1E+38;
  ENDPROC

  ! Newton's method.
  FUNC num root_of(num x)
    VAR num guess;

    guess:=x;
    WHILE Abs(guess*guess-x)>0.000001 DO
      guess:=(guess+x/guess)/2;
    ENDWHILE
    RETURN guess;
  ENDFUNC

  ! The area below a quarter of the unit circle, by the midpoints of strips.
  FUNC num quarter_circle(num strips)
    VAR num area:=0;
    VAR num x;

    FOR i FROM 1 TO strips DO
      x:=(i-0.5)/strips;
      area:=area+Sqrt(1-x*x)/strips;
    ENDFOR
    RETURN area;
  ENDFUNC

  FUNC num harmonic(num terms)
    VAR num sum:=0;

    FOR i FROM 1 TO terms DO
      sum:=sum+1/i;
    ENDFOR
    RETURN sum;
  ENDFUNC

  PROC overflowing(num start)
    VAR num x;

    x:=start;
    WHILE x>0 DO
      x:=x*2;
    ENDWHILE
  ERROR
    TPWrite "overflow after "\Num:=x;
    RETURN;
  ENDPROC
ENDMODULE
